#include "pipeline/measured_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/prepared_scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kCoarse_m = 0.5;

PointMoments moments(const Vector3d& mean, const Vector3d& variances) {
  PointMoments out;
  out.mean = mean;
  out.covariance = variances.asDiagonal();
  return out;
}

PoseUncertainty known_about(const Vector3d& centre) {
  PoseUncertainty u;
  u.determined = true;
  u.centre = centre;
  u.covariance.setZero();
  return u;
}

TEST(SigmaInVoxels, OfAShiftIsThatOfEveryPoint) {
  PoseUncertainty u = known_about(Vector3d::Zero());
  u.covariance.diagonal().tail<3>() = Vector3d(0.01, 0.04, 0.04);
  const PointMoments points = moments({7, -3, 2}, {4, 1, 0.25});
  const auto sigma = sigma_in_voxels(u, points, Isometry3d(Eigen::Translation3d(5, 5, 5)), kCoarse_m);
  ASSERT_TRUE(sigma);
  EXPECT_NEAR(*sigma, 0.3 / kCoarse_m, 1e-12) << "wherever the points lie";
}

TEST(SigmaInVoxels, OfATurnGrowsWithTheDistanceFromItsCentre) {
  PoseUncertainty u = known_about({1, 0, 0});
  u.covariance(2, 2) = 1e-4;  // about z: 0.01 rad
  const PointMoments at_centre = moments({1, 0, 0}, {9, 16, 100});
  const auto own = sigma_in_voxels(u, at_centre, Isometry3d::Identity(), kCoarse_m);
  ASSERT_TRUE(own);
  EXPECT_NEAR(*own, 0.01 * 5 / kCoarse_m, 1e-12) << "heights do not move";
  const auto far = sigma_in_voxels(u, at_centre, Isometry3d(Eigen::Translation3d(12, 0, 3)), kCoarse_m);
  ASSERT_TRUE(far);
  EXPECT_NEAR(*far, 0.01 * 13 / kCoarse_m, 1e-12);
}

TEST(SigmaInVoxels, ThereIsNoneWhereThePoseIsNotDetermined) {
  PoseUncertainty u = known_about(Vector3d::Zero());
  u.determined = false;
  EXPECT_FALSE(sigma_in_voxels(u, {}, Isometry3d::Identity(), kCoarse_m));
}

class MeasuredScan : public ::testing::Test {
 protected:
  MeasuredScan()
      : s_(testing::prepared_scene(
            {.shape = testing::SyntheticShape::kYard, .num_scans = 3, .points_per_scan = 5000, .noise_m = 0.02},
            rng_)) {
    for (std::size_t i = 0; i < 3; ++i) T_.push_back(s_.scene.T_target_source(0, i));
  }
  ScanMeasurements measured(const std::vector<LinkOfScan>& links) const { return measure_scan(s_.scans, 1, links, T_); }

  Rng rng_ = make_stream(1, "measured_scan_test");
  testing::PreparedScene s_;
  std::vector<Isometry3d> T_;
};

TEST_F(MeasuredScan, AgreesWhereItIsAndNotBesideIt) {
  const LinkMeasurements link;
  const auto here = measured({{0, &link}, {2, &link}});
  T_[1] = T_[1] * Eigen::Translation3d(0.4, 0.4, 0.4);
  const auto beside = measured({{0, &link}, {2, &link}});
  EXPECT_GT(here.evidence.inlier_share, 0.8);
  EXPECT_LT(beside.evidence.inlier_share, 0.6 * here.evidence.inlier_share);
}

TEST_F(MeasuredScan, WhatItsPairsSeeAddsUp) {
  LinkMeasurements one, other;
  one.free_space = {100, 3, 50, 1};
  other.free_space = {200, 4, 60, 2};
  const auto m = measured({{0, &one}, {2, &other}});
  EXPECT_EQ(m.free_space.num_points, 300u);
  EXPECT_EQ(m.free_space.num_violating, 7u);
  EXPECT_EQ(m.free_space.num_matches, 110u);
  EXPECT_EQ(m.free_space.num_opposed, 3u);
}

TEST_F(MeasuredScan, WithoutPairsNothingIsMeasured) {
  const auto m = measured({});
  EXPECT_EQ(m.evidence.num_points, 0u);
  EXPECT_FALSE(m.free_space.tells());
  EXPECT_FALSE(m.sigma_in_voxels);
}

}  // namespace
}  // namespace tcm_icp
