#pragma once
// What a scan looks like from above: the highest point and share of walls per cell, and how they stand out.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

struct HeightMapOptions {
  double smoothing_cells = 12;  ///< > 0; standard deviation of the mean that heights are taken against
  double clip_sigma = 2.5;      ///< > 0; details beyond so many standard deviations count as that many
  void validate() const;        ///< throws InvalidOptions
};

/// Square grid about the middle of the scan. All but `cell_m` and the pose is in cells, so that floats hold the same in
/// any unit (decision 0015). Cell (row r, column c) is centred on ((c - size/2), (r - size/2)) cells.
struct HeightMap {
  Eigen::Isometry3d T_map_scan = Eigen::Isometry3d::Identity();  ///< z up, origin over the middle of the scan
  double cell_m = 0;
  int size = 0;                  ///< cells an edge; even
  std::vector<float> height;     ///< [cells] row by row; 0 where nothing was seen
  std::vector<float> detail;     ///< height less its smooth mean, clipped, variance 1; 0 where nothing was seen
  std::vector<float> structure;  ///< the same of the share of points on walls; 0 throughout where normals are missing
  std::vector<float> mask;       ///< 1 where something was seen, 0 elsewhere
  int num_seen = 0;              ///< cells with mask 1
};

/// What the scan covers seen from `up`, but for the outermost hundredths of its points.
struct Footprint {
  Eigen::Isometry3d T_map_scan = Eigen::Isometry3d::Identity();  ///< z up, origin in the middle
  double radius_m = 0;                                           ///< [m] of the circle about the middle
  double width_m = 0;  ///< [m] edge of the square as large as the rectangle along the principal axes
};

/// @pre points is not empty, up has length 1
Footprint find_footprint(const Points& points, const Eigen::Vector3d& up);

/// The map of the points inside the footprint. O(N + cells x smoothing_cells).
/// @param cell_m  > 0
HeightMap make_height_map(const Cloud& cloud, const Footprint& footprint, double cell_m,
                          const HeightMapOptions& options = {});

}  // namespace tcm_icp
