#include "pipeline/pose_graph_edges.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Six axes of no particular direction, sigmas from 1 mm to 6 mm.
LinkStrength some_strength() {
  LinkStrength strength;
  strength.centre << 5, -7, 2;
  strength.radius_m = 8;
  Matrix6 mixed;
  for (int i = 0; i < 36; ++i) mixed(i / 6, i % 6) = std::sin(1.7 * i * i);
  const Matrix6 axes = Eigen::SelfAdjointEigenSolver<Matrix6>(mixed + mixed.transpose()).eigenvectors();
  for (int k = 0; k < 6; ++k) {
    auto& axis = strength.axes[static_cast<std::size_t>(k)];
    axis.rotation_per_m = axes.col(k).head<3>() / strength.radius_m;
    axis.translation = axes.col(k).tail<3>();
    axis.sigma_m = 1e-3 * (6 - k);
  }
  return strength;
}

Eigen::Isometry3d some_pose() {
  Twist twist;
  twist << 0.4, -1.2, 2.1, 10, 20, -5;
  return isometry_from_twist(twist);
}

/// What an error of the relative pose, as g2o has it, costs by the axes of the link; by moving points.
double cost_by_motion(const LinkStrength& strength, const Eigen::Isometry3d& T_common_to, const Twist& error) {
  const Eigen::Vector3d v = error.tail<3>();
  Eigen::Isometry3d D = Eigen::Isometry3d::Identity();
  D.linear() = Eigen::Quaterniond(std::sqrt(1 - v.squaredNorm()), v.x(), v.y(), v.z()).toRotationMatrix();
  D.translation() = error.head<3>();
  const Eigen::Isometry3d E = T_common_to * D * T_common_to.inverse();
  const Eigen::AngleAxisd turn(E.linear());
  Twist motion;
  motion << strength.radius_m * turn.angle() * turn.axis(), E * strength.centre - strength.centre;
  double cost = 0;
  for (const auto& axis : strength.axes) {
    Twist direction;
    direction << strength.radius_m * axis.rotation_per_m, axis.translation;
    cost += std::pow(direction.dot(motion) / axis.sigma_m, 2);
  }
  return cost;
}

TEST(EdgeInformation, CostsAMotionWhatTheAxesOfTheLinkSay) {
  const LinkStrength strength = some_strength();
  const Eigen::Isometry3d T = some_pose();
  const auto information = edge_information(strength, T);
  ASSERT_TRUE(information);
  EXPECT_EQ(*information, information->transpose());
  for (int k = 0; k < 20; ++k) {
    Twist error;
    for (int i = 0; i < 6; ++i) error[i] = 1e-5 * std::sin(3.1 * k + 1.3 * i * i);
    const double cost = cost_by_motion(strength, T, error);
    EXPECT_NEAR(error.dot(*information * error), cost, 1e-3 * cost) << k;  // second order in 1e-5, over 10 m levers
  }
}

TEST(EdgeInformation, ADirectionThatNothingHoldsHasNone) {
  LinkStrength strength = some_strength();
  strength.axes[2].sigma_m = std::numeric_limits<double>::infinity();
  const auto information = edge_information(strength, some_pose());
  ASSERT_TRUE(information);
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(*information);
  EXPECT_LT(std::abs(eigen.eigenvalues()[0]), 1e-9 * eigen.eigenvalues()[5]);
  EXPECT_GT(eigen.eigenvalues()[1], 1e-6 * eigen.eigenvalues()[5]);
  for (auto& axis : strength.axes) axis.sigma_m = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(edge_information(strength, some_pose()));
}

TEST(PoseGraphEdges, AreTheAcceptedLinksBetweenRegisteredScans) {
  PipelineResult result;
  result.scans.resize(4);
  result.poses.resize(4);
  result.scans[0].origin << 100, 0, 0;
  result.poses[0].status = ScanStatus::kReference;
  result.poses[1].status = result.poses[2].status = ScanStatus::kRegistered;
  const auto add = [&](std::size_t a, std::size_t b, Verdict verdict) {
    result.links.push_back({});
    result.links.back().a = a;
    result.links.back().b = b;
    result.links.back().verdict = verdict;
  };
  add(0, 1, Verdict::kAccepted);
  add(1, 2, Verdict::kAccepted);
  add(0, 2, Verdict::kDoubtful);
  add(2, 3, Verdict::kAccepted);  // 3 is unregistered
  result.links[0].strength = some_strength();
  result.poses[1].T_reference_scan = some_pose();
  const auto edges = pose_graph_edges(result);
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(edges[0].from, 0u);
  EXPECT_EQ(edges[0].to, 1u);
  // The strength's centre is relative to the reference's origin.
  Eigen::Isometry3d local = some_pose();
  local.translation().x() -= 100;
  EXPECT_LT((edges[0].information - *edge_information(some_strength(), local)).norm(), 1e-6);
  EXPECT_EQ(edges[1].information, Matrix6::Identity());
}

}  // namespace
}  // namespace tcm_icp
