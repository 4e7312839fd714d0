#pragma once
// Boxes by their extents, for things that stand on the ground, and what buildings are made of.

#include <Eigen/Geometry>

namespace tcm_icp {

constexpr double kPlaster = 0.7, kConcrete = 0.5;  ///< reflectivities
constexpr double kObjectFooting_m = 0.5;           ///< objects go on below the ground, which is not level

inline Eigen::AlignedBox3d box(double x0, double x1, double y0, double y1, double z0, double z1) {
  return {Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1)};
}

}  // namespace tcm_icp
