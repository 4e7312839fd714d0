#include "tcm_icp/registration/verification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "registration/level_of.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

VerificationOptions options() { return {.gate_m = 1.0, .tolerance_m = 0.1, .slide_m = 2.0}; }

PyramidLevel half_metre_level(const Cloud& cloud) { return testing::level_of(cloud, 0.5); }

// Points half a metre apart, none on an edge where planes meet, on `cells` x `cells` half metres of the plane spanned
// by two axes, middle at the origin.
void add_grid(const Vector3d& u, const Vector3d& v, int cells, Cloud& cloud) {
  for (int i = -cells / 2; i < cells / 2; ++i) {
    for (int j = -cells / 2; j < cells / 2; ++j) {
      cloud.points.emplace_back((0.5 * i + 0.25) * u + (0.5 * j + 0.25) * v);
      cloud.normals.emplace_back(u.cross(v));
    }
  }
}

Cloud floor_of(int cells) {
  Cloud cloud;
  add_grid(Vector3d::UnitX(), Vector3d::UnitY(), cells, cloud);
  return cloud;
}

// Three planes through the origin.
Cloud corner(int cells) {
  Cloud cloud = floor_of(cells);
  add_grid(Vector3d::UnitY(), Vector3d::UnitZ(), cells, cloud);
  add_grid(Vector3d::UnitZ(), Vector3d::UnitX(), cells, cloud);
  return cloud;
}

TEST(VerifyAlignment, SharesAreAsCountedByHand) {
  const PyramidLevel target = half_metre_level(floor_of(40));
  const Vector3d up = Vector3d::UnitZ();
  Cloud points;
  for (const double z : {0.02, -0.03, 0.04, 0.05, -0.06, 0.08}) {  // within the tolerance
    points.points.emplace_back(z * 10, 1, z);
    points.normals.push_back(z < 0 ? Vector3d(-up) : up);  // a normal's sign says nothing
  }
  points.points.emplace_back(1, 1, 0.3);  // overlaps, off the plane
  points.normals.push_back(up);
  points.points.emplace_back(2, 1, 0.01);  // overlaps, faces another way
  points.normals.push_back(Vector3d::UnitX());
  points.points.emplace_back(0, 0, 1.5);  // out of reach
  points.normals.push_back(up);
  points.points.emplace_back(100, 0, 0);
  points.normals.push_back(up);
  const AlignmentEvidence evidence = verify_alignment(points, target, Isometry3d::Identity(), options());
  EXPECT_EQ(evidence.num_points, 10u);
  EXPECT_DOUBLE_EQ(evidence.overlap, 0.8);
  EXPECT_DOUBLE_EQ(evidence.inlier_share, 6.0 / 8);
  EXPECT_DOUBLE_EQ(evidence.consensus(), 0.6);
  EXPECT_NEAR(evidence.median_residual_m, 0.05, 1e-15);  // the fifth of eight: 0.01 0.02 0.03 0.04 | 0.05
}

TEST(VerifyAlignment, NothingChangesWhenBothCloudsMove) {
  Rng rng = make_stream(1, "verification_test");
  const Isometry3d A = testing::random_pose(20, rng), B = testing::random_pose(20, rng);
  const Isometry3d T(Eigen::Translation3d(0.01, 0.02, 0.05));
  const auto still = verify_alignment(corner(10), half_metre_level(corner(20)), T, options());
  const auto moved = verify_alignment(transformed(corner(10), B), half_metre_level(transformed(corner(20), A)),
                                      A * T * B.inverse(), options());
  ASSERT_GT(still.inlier_share, 0.5);
  EXPECT_DOUBLE_EQ(moved.overlap, still.overlap);
  EXPECT_DOUBLE_EQ(moved.inlier_share, still.inlier_share);
  EXPECT_NEAR(moved.median_residual_m, still.median_residual_m, 1e-12);
}

TEST(VerifyAlignment, APlaneSlidesInThreeDirectionsAndACornerInNone) {
  // 20 m of floor, and 5 m on it: nothing runs over the edge when it slides by 2 m.
  const auto plane = verify_alignment(floor_of(10), half_metre_level(floor_of(40)), Isometry3d::Identity(), options());
  EXPECT_DOUBLE_EQ(plane.consensus(), 1);
  for (int k = 0; k < 3; ++k) EXPECT_GT(plane.left_after_slide[static_cast<std::size_t>(k)], 0.95) << k;
  for (int k = 3; k < 6; ++k) EXPECT_LT(plane.left_after_slide[static_cast<std::size_t>(k)], 0.2) << k;

  // Whichever way three planes slide by 2 m, at most the two along the way stay.
  const auto in_corner = verify_alignment(corner(10), half_metre_level(corner(40)), Isometry3d::Identity(), options());
  EXPECT_DOUBLE_EQ(in_corner.consensus(), 1);
  EXPECT_LT(in_corner.left_after_slide[0], 0.7);
  EXPECT_TRUE(std::is_sorted(in_corner.left_after_slide.rbegin(), in_corner.left_after_slide.rend()));
}

// 40 m of floor and walls, and a few posts' faces across them.
TEST(VerifyAlignment, WhatLiesAcrossACorridorHoldsIt) {
  Cloud along, posts;
  for (double x = -20; x < 20; x += 0.25) {
    for (double s = 0.25; s < 3; s += 0.5) {
      along.points.emplace_back(x, s - 1.5, 0);
      along.normals.push_back(Vector3d::UnitZ());
      for (const double y : {-1.5, 1.5}) {
        along.points.emplace_back(x, y, s);
        along.normals.push_back(Vector3d::UnitY());
      }
    }
  }
  for (const double x : {-13.0, -8.0, -1.0, 5.0, 12.0}) {
    for (double z = 0.5; z < 3; z += 0.25) {
      posts.points.emplace_back(x, 1.1, z);
      posts.normals.push_back(Vector3d::UnitX());
    }
  }
  Cloud corridor = along;
  corridor.points.insert(corridor.points.end(), posts.points.begin(), posts.points.end());
  corridor.normals.insert(corridor.normals.end(), posts.normals.begin(), posts.normals.end());

  const auto held = verify_alignment(corridor, half_metre_level(corridor), Isometry3d::Identity(), options());
  EXPECT_GT(held.left_after_slide[0], 0.85) << "it slides as a whole";
  EXPECT_EQ(held.num_across, posts.size());
  EXPECT_EQ(held.left_across, 0);
  const auto bare = verify_alignment(along, half_metre_level(along), Isometry3d::Identity(), options());
  EXPECT_GT(bare.left_after_slide[0], 0.85);
  EXPECT_EQ(bare.num_across, 0u);
  EXPECT_EQ(bare.left_across, 1) << "nothing holds it";
}

TEST(VerifyAlignment, ATargetWithoutNormalsCannotAgree) {
  PyramidLevel target = half_metre_level(corner(20));
  for (auto& n : target.cloud.normals) n.setZero();
  const auto evidence = verify_alignment(corner(10), target, Isometry3d::Identity(), options());
  EXPECT_DOUBLE_EQ(evidence.overlap, 1);
  EXPECT_EQ(evidence.inlier_share, 0);
  EXPECT_EQ(evidence.left_after_slide[0], 1) << "no agreement holds it";
}

TEST(VerifyAlignment, NothingHeldOutIsNoEvidence) {
  for (const std::size_t count : {0u, 1u}) {
    const Cloud points{Points(count, Vector3d::Zero()), Points(count, Vector3d::UnitZ())};
    const auto evidence = verify_alignment(points, half_metre_level(floor_of(10)), Isometry3d::Identity(), options());
    EXPECT_EQ(evidence.consensus(), 0);
    EXPECT_EQ(evidence.left_after_slide[0], 1);
  }
}

TEST(VerifyAlignment, WithoutSlidesTheConsensusIsTheSame) {
  VerificationOptions hasty = options();
  hasty.with_slides = false;
  const Isometry3d T(Eigen::Translation3d(0.01, 0.02, 0.05));
  const auto full = verify_alignment(corner(10), half_metre_level(corner(20)), T, options());
  const auto brief = verify_alignment(corner(10), half_metre_level(corner(20)), T, hasty);
  EXPECT_EQ(brief.consensus(), full.consensus());
  EXPECT_EQ(brief.median_residual_m, full.median_residual_m);
  EXPECT_LT(full.left_after_slide[0], 1);
  EXPECT_EQ(brief.left_after_slide[0], 1) << "not looked at";
}

TEST(VerificationOptions, RejectValuesOutOfRange) {
  EXPECT_NO_THROW(options().validate());
  const auto throws = [](auto change) {
    VerificationOptions o = options();
    change(o);
    EXPECT_THROW(o.validate(), InvalidOptions);
  };
  throws([](auto& o) { o.gate_m = 0; });
  throws([](auto& o) { o.tolerance_m = -1; });
  throws([](auto& o) { o.slide_m = std::nan(""); });
  throws([](auto& o) { o.max_normal_angle_deg = 91; });
}

}  // namespace
}  // namespace tcm_icp
