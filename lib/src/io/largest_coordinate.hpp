#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace tcm_icp {

/// The largest absolute value of a coordinate in the box: what the resolution of floating-point numbers depends on.
/// @pre the box is not empty
inline double largest_coordinate(const Eigen::AlignedBox3d& box) {
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

}  // namespace tcm_icp
