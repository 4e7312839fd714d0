#include "tcm_icp/registration/correspondences.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "registration/level_of.hpp"
#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::level_of;

// By loop over all pairs.
Correspondences slowly(const Cloud& source, const Isometry3d& T, const Cloud& target, const CorrespondenceGate& gate) {
  Correspondences out;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Vector3d p = T * source.points[i];
    std::size_t best = 0;
    for (std::size_t j = 1; j < target.size(); ++j) {
      if ((target.points[j] - p).norm() < (target.points[best] - p).norm()) best = j;
    }
    const double cosine = std::abs((T.linear() * source.normals[i]).dot(target.normals[best]));
    if ((target.points[best] - p).norm() > gate.max_distance_m) continue;
    if (std::acos(std::min(1.0, cosine)) > gate.max_normal_angle_rad) continue;
    out.push_back({p, target.points[best], target.normals[best], cosine});
  }
  return out;
}

TEST(FindCorrespondences, EqualsALoopOverAllPairs) {
  Rng rng = make_stream(1, "correspondences_test");
  const auto scene = testing::synthetic_scene({.points_per_scan = 400, .noise_m = 0.05}, rng);
  const Isometry3d T = testing::perturbed(scene.T_target_source(0, 1), scene.scans[1].points, 0.1, 0.5, rng);
  const CorrespondenceGate gate{1.0, 0.6};
  const auto expected = slowly(scene.scans[1], T, scene.scans[0], gate);
  const auto found = find_correspondences(scene.scans[1], T, level_of(scene.scans[0]), gate);
  ASSERT_GT(expected.size(), 50u);
  ASSERT_LT(expected.size(), 350u) << "the gate was meant to close on some";
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(testing::is_near(expected[i].source, found[i].source, 1e-12));
    EXPECT_EQ(expected[i].target, found[i].target);
    EXPECT_EQ(expected[i].normal, found[i].normal);
    EXPECT_NEAR(expected[i].agreement, found[i].agreement, 1e-12);
  }
}

TEST(FindCorrespondences, TheOtherSidesNormalStandsInAndTwoUnknownOnesAreNoPlane) {
  const Vector3d none = Vector3d::Zero(), up = Vector3d::UnitZ();
  const Cloud source{{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}, {up, none, none}};
  const Cloud target{{{0, 0, 0.1}, {10, 0, 0.1}, {20, 0, 0.1}}, {none, up, none}};
  const auto found = find_correspondences(source, Isometry3d::Identity(), level_of(target), {1, 0.5});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].normal, up);
  EXPECT_EQ(found[1].normal, up);
}

TEST(FindCorrespondences, ANormalsSignSaysNothingAndTheSourcesTurnsWithThePose) {
  const Cloud source{{{0, 0, 0}}, {Vector3d::UnitX()}}, target{{{0, 0, 0}}, {-Vector3d::UnitZ()}};
  const CorrespondenceGate gate{1, 0.1};
  EXPECT_TRUE(find_correspondences(source, Isometry3d::Identity(), level_of(target), gate).empty());
  const Isometry3d quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitY()));
  EXPECT_EQ(find_correspondences(source, quarter, level_of(target), gate).size(), 1u);
}

TEST(FindCorrespondences, EmptyCloudsHaveNone) {
  const Cloud one{{{0, 0, 0}}, {Vector3d::UnitZ()}};
  EXPECT_TRUE(find_correspondences({}, Isometry3d::Identity(), level_of(one), {1, 1}).empty());
  EXPECT_TRUE(find_correspondences(one, Isometry3d::Identity(), level_of({}), {1, 1}).empty());
}

}  // namespace
}  // namespace tcm_icp
