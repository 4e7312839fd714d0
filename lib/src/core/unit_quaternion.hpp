#pragma once

#include <Eigen/Geometry>

namespace tcm_icp {

/// The rotation of T as the one of its two unit quaternions that has w >= 0.
inline Eigen::Quaterniond unit_quaternion(const Eigen::Isometry3d& T) {
  Eigen::Quaterniond q(T.linear());
  q.normalize();
  if (q.w() < 0) q.coeffs() *= -1;
  return q;
}

}  // namespace tcm_icp
