#pragma once
// Where a scan was taken from, found in its points alone.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

/// What told where a scan was taken from.
enum class ViewpointEvidence { kScanLines, kDensity, kOcclusion };

/// The place about which a scan's lines were swept, from which points lie as densely as they do, or from which the
/// fewest of them hide behind others.
struct Viewpoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< in the cloud's frame
  /// 0..1; points amid what others hide from there, where scan lines did not tell the place. A scanner sees all its
  /// points: noise and edges are left.
  double hidden_share = 1;
  /// [m] moves of this length leave as few hidden; three sigma where scan lines or density told the place
  double radius_m = 0;
  double extent_m = 0;  ///< [m] middle edge of the box about 94 % of the points, along their principal axes
  Points alternatives;  ///< places about as good, spread out; `place` is not among them
  ViewpointEvidence evidence = ViewpointEvidence::kOcclusion;
  double line_share = 0;  ///< 0..1; pieces of scan lines that agree with the place; 0 where something else told it
  double allowed_hidden_share = 0;  ///< 0..1; as many may be hidden from the place of a scanner, for so few points

  /// Whether the scan has one place it was taken from, and shows where. A strip of an airborne sensor has none; without
  /// scan lines, shapes without anything in front of anything else look alike from many places.
  bool determined() const;
  /// Less is asked: enough to tell the sides of surfaces, where the alternatives agree.
  bool roughly_determined() const;

 private:
  bool within(double share_of_extent) const;
};

/// Searches a grid of places in the box about the points, grown by 0.3 of its edges on each side, then from the best of
/// them with narrower bins of directions and more points. All lengths are shares of the middle edge, all directions
/// those of the points' principal axes, so that units and frames do not matter but for rounding.
/// @param cloud    with normals; points without are not looked at
/// @param guesses  places to start from beside the grid, such as the origin of the file; those outside of the box do
///                 not count
/// @return         nothing where fewer than 200 points have a normal, or they lie on a line
/// Cost: 35 to 180 ms, whatever the number of points.
std::optional<Viewpoint> find_viewpoint(const Cloud& cloud, std::span<const Eigen::Vector3d> guesses, Rng& rng);

}  // namespace tcm_icp
