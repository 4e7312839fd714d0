#pragma once
// The lowest and the highest point over each cell of a plan.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

struct Envelope {
  double cell_m = 0;
  int width = 0, height = 0;
  std::vector<float> lowest, highest;  ///< [cells] NaN where the cell is empty; row by row

  int num_occupied() const;
};

/// Rotation that takes `up` to +z by the shortest way.
Eigen::Matrix3d levelling_rotation(const Eigen::Vector3d& up);

/// Envelope of the points turned by `R_level_scan`.
Envelope make_envelope(const Points& points, const Eigen::Matrix3d& R_level_scan, double cell_m);

/// Typical step [cells] between occupied neighbours of the grid: geometric mean of the steps' median and upper
/// quartile, since the one alone is nearly equal on both sides of a sparse scan, the other on both sides of a room;
/// infinity where no cells touch.
double roughness(const Envelope& envelope, const std::vector<float>& heights);

}  // namespace tcm_icp
