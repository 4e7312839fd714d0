#pragma once
// Comparisons with a tolerance that say what differs. NaN fails every one of them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp::testing {

/// Largest coefficient of the difference is at most `tolerance`; the sizes must match.
template <typename A, typename B>
::testing::AssertionResult is_near(const Eigen::MatrixBase<A>& expected, const Eigen::MatrixBase<B>& actual,
                                   double tolerance) {
  if (expected.rows() != actual.rows() || expected.cols() != actual.cols()) {
    return ::testing::AssertionFailure() << "sizes differ: " << expected.rows() << " x " << expected.cols() << " and "
                                         << actual.rows() << " x " << actual.cols();
  }
  // Coefficient by coefficient: Eigen's maximum may skip a NaN.
  for (Eigen::Index i = 0; i < expected.rows(); ++i) {
    for (Eigen::Index j = 0; j < expected.cols(); ++j) {
      if (std::abs(expected(i, j) - actual(i, j)) <= tolerance) continue;
      return ::testing::AssertionFailure() << "(" << i << ", " << j << ") is " << actual(i, j) << ", not "
                                           << expected(i, j) << " within " << tolerance << "\nexpected\n"
                                           << expected << "\nactual\n"
                                           << actual;
    }
  }
  return ::testing::AssertionSuccess();
}

/// Angle and distance between two poses.
inline ::testing::AssertionResult is_pose_near(const Eigen::Isometry3d& expected, const Eigen::Isometry3d& actual,
                                               double rotation_tolerance_rad, double translation_tolerance_m) {
  const double angle = rotation_angle_rad(expected.linear().transpose() * actual.linear());
  const double shift = (expected.translation() - actual.translation()).norm();
  if (angle <= rotation_tolerance_rad && shift <= translation_tolerance_m) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "poses differ by " << angle << " rad (tolerance " << rotation_tolerance_rad
                                       << ") and " << shift << " m (tolerance " << translation_tolerance_m << ")";
}

/// Point by point, in order.
inline ::testing::AssertionResult are_points_near(const Points& expected, const Points& actual, double tolerance) {
  if (expected.size() != actual.size()) {
    return ::testing::AssertionFailure() << actual.size() << " points, not " << expected.size();
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto result = is_near(expected[i], actual[i], tolerance);
    if (!result) return ::testing::AssertionFailure() << "point " << i << ": " << result.message();
  }
  return ::testing::AssertionSuccess();
}

}  // namespace tcm_icp::testing
