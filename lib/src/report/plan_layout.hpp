#pragma once
// Where the scans of a group stand in the top view of report.html.

#include <Eigen/Core>
#include <vector>

namespace tcm_icp::html {

struct PlanLayout {
  double width = 0, height = 0;                        ///< of the drawing, in its own units
  double scale = 1;                                    ///< drawing units a metre
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();  ///< what is in the middle of the drawing
  double disc = 0;                                     ///< radius of a scan's disc
  std::vector<Eigen::Vector2d> at;                     ///< of each scan, y downwards
  bool moved = false;                                  ///< discs that would have covered one another were moved apart
};

/// North, y of the frame, is up. The drawing shows all middles, and around them as much of what the scans cover as
/// leaves the middles most of the room. Deterministic. Cost O(n^2).
/// @param middles    n x 2 [m], finite
/// @param extents_m  n, >= 0
PlanLayout lay_out_plan(const std::vector<Eigen::Vector2d>& middles, const std::vector<double>& extents_m);

/// The largest of 1, 2 or 5 times a power of ten that is not above `length_m`. @pre length_m > 0
double round_length(double length_m);

}  // namespace tcm_icp::html
