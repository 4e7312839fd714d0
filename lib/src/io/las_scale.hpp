#pragma once
// By which scale and offset coordinates become the 32-bit integers of LAS.

#include <Eigen/Geometry>

namespace tcm_icp {

struct LasScale {
  double step = 0.001;        ///< the scale, of all axes
  bool is_by_extent = false;  ///< a finer one would not reach over the box; otherwise doubles tell no more
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// The finest scale of the form 1, 2 or 5 times a power of ten by which the box has room in 32 bits, but no finer than
/// what doubles tell apart at its far corner. For an empty box the scale is 0.001.
LasScale choose_las_scale(const Eigen::AlignedBox3d& box);

}  // namespace tcm_icp
