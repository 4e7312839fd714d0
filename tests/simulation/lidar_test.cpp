#include "tcm_icp/simulation/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/simple_scenes.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::ground;
using testing::room;
using testing::scan_with;

/// Free of errors and of thinning: each ray that meets something returns.
ScannerOptions ideal() {
  ScannerOptions options;
  options.step_deg = 2;
  options.range_noise_m = 0;
  options.angular_noise_deg = 0;
  options.full_return_signal = 1e-9;
  options.thinning_voxel_m = 0;
  options.isolated_share = 0;
  return options;
}

const Isometry3d kTilted(Translation3d(0.5, -0.3, 0.2) * Eigen::AngleAxisd(0.8, Vector3d(1, 2, 3).normalized()));

TEST(Lidar, EachIdealReturnLiesOnTheRoomsWallsAndEveryRayReturns) {
  const RayCaster scene = room();
  const LidarScan scan = scan_with(scene, kTilted, ideal());
  EXPECT_EQ(scan.cloud.size(), 180u * 66u);  // azimuths x elevations from -60 to 70 degrees
  for (const auto& p : scan.cloud.points) EXPECT_LT(scene.distance_m(kTilted * p), 1e-9);
}

TEST(Lidar, SeesGroundOnlyWithinItsRangeAndBelowTheHorizon) {
  ScannerOptions options = ideal();
  options.max_range_m = 20;
  const LidarScan scan = scan_with(ground(), Isometry3d(Translation3d(0, 0, 1.8)), options);
  ASSERT_FALSE(scan.cloud.empty());
  for (const auto& p : scan.cloud.points) {
    EXPECT_NEAR(p.z(), -1.8, 1e-9);
    EXPECT_LE(p.norm(), 20 + 1e-9);
  }
  // Elevations -60, -58, ... -6: the next, -4 degrees, meets the ground at 25.8 m.
  EXPECT_EQ(scan.cloud.size(), 180u * 28u);
}

TEST(Lidar, RangeNoiseHasTheGivenStandardDeviationAndNoBias) {
  ScannerOptions options = ideal();
  options.range_noise_m = 0.02;
  const LidarScan exact = scan_with(room(), kTilted, ideal());
  const LidarScan noisy = scan_with(room(), kTilted, options);
  ASSERT_EQ(exact.cloud.size(), noisy.cloud.size());
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < exact.cloud.size(); ++i) {
    const double error = noisy.cloud.points[i].norm() - exact.cloud.points[i].norm();
    sum += error;
    squares += error * error;
  }
  const double n = static_cast<double>(exact.cloud.size());
  // Four standard deviations of the estimates themselves.
  EXPECT_NEAR(sum / n, 0, 4 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 4 * 0.02 / std::sqrt(2 * n));
}

TEST(Lidar, AngularNoiseMovesTheRangeAndNotTheRecordedDirection) {
  ScannerOptions options = ideal();
  options.angular_noise_deg = 0.5;
  const LidarScan exact = scan_with(room(), kTilted, ideal());
  const LidarScan noisy = scan_with(room(), kTilted, options);
  ASSERT_EQ(exact.cloud.size(), noisy.cloud.size());
  double moved = 0;
  for (std::size_t i = 0; i < exact.cloud.size(); ++i) {
    const Vector3d& a = exact.cloud.points[i];
    const Vector3d& b = noisy.cloud.points[i];
    EXPECT_LT(a.normalized().cross(b.normalized()).norm(), 1e-9);
    moved = std::max(moved, (a - b).norm());
  }
  EXPECT_GT(moved, 0.01);
}

TEST(Lidar, ASignalBelowTheFullOneReturnsInProportion) {
  // From the middle of a ball-like room all signals are near the reflectivity; straight up and down exactly so.
  ScannerOptions options = ideal();
  TriangleMesh mesh;
  add_frustum(mesh, Isometry3d(Translation3d(0, 0, -50)), {5, 5, 100, 720}, 0.05);
  options.min_elevation_deg = -1;
  options.max_elevation_deg = 1;
  options.step_deg = 0.1;
  options.full_return_signal = 0.2;
  const LidarScan scan = scan_with(RayCaster(mesh), Isometry3d::Identity(), options);
  const double rays = 3600 * 21;
  const double share = static_cast<double>(scan.cloud.size()) / rays;
  EXPECT_NEAR(share, 0.25, 4 * std::sqrt(0.25 * 0.75 / rays) + 1e-4);  // 1e-4: incidence is up to 1 degree off
  for (const float signal : scan.intensity) EXPECT_NEAR(signal, 0.05F, 1e-4F);
}

TEST(Lidar, GroundFadesWithGrazingIncidence) {
  ScannerOptions options = ideal();
  options.full_return_signal = 0.1;
  const LidarScan all = scan_with(ground(), Isometry3d(Translation3d(0, 0, 1.8)), ideal());
  const LidarScan some = scan_with(ground(), Isometry3d(Translation3d(0, 0, 1.8)), options);
  const auto count = [](const LidarScan& scan, double from_m, double to_m) {
    return std::count_if(scan.cloud.points.begin(), scan.cloud.points.end(),
                         [&](const Vector3d& p) { return p.norm() >= from_m && p.norm() < to_m; });
  };
  EXPECT_EQ(count(some, 0, 5), count(all, 0, 5));  // signal 0.3 * 1.8 / 5 = 0.108: certain
  EXPECT_LT(count(some, 20, 60), count(all, 20, 60) / 2);
  EXPECT_GT(count(some, 20, 60), 0);
}

TEST(Lidar, ThinningKeepsOneReturnAVoxel) {
  ScannerOptions options = ideal();
  options.thinning_voxel_m = 0.5;
  const LidarScan all = scan_with(room(), kTilted, ideal());
  const LidarScan thinned = scan_with(room(), kTilted, options);
  ASSERT_GT(thinned.cloud.size(), 100u);
  EXPECT_LT(thinned.cloud.size(), all.cloud.size() / 2);
  std::vector<std::array<double, 3>> voxels;
  for (const auto& p : thinned.cloud.points) {
    const Vector3d v = (p / 0.5).array().floor();
    voxels.push_back({v.x(), v.y(), v.z()});
  }
  std::sort(voxels.begin(), voxels.end());
  EXPECT_EQ(std::adjacent_find(voxels.begin(), voxels.end()), voxels.end());
}

TEST(Lidar, IsolatedReturnsAreInMidAirAndAsManyAsAskedFor) {
  ScannerOptions options = ideal();
  options.isolated_share = 0.05;
  const RayCaster scene = room();
  const LidarScan without = scan_with(scene, kTilted, ideal());
  const LidarScan with = scan_with(scene, kTilted, options);
  ASSERT_EQ(with.cloud.size() - without.cloud.size(), std::lround(0.05 * static_cast<double>(without.cloud.size())));
  std::size_t in_air = 0;
  for (std::size_t i = 0; i < with.cloud.size(); ++i) {
    const Vector3d world = kTilted * with.cloud.points[i];
    EXPECT_TRUE((world.cwiseAbs().array() <= Vector3d(4, 3, 2).array() + 1e-9).all());
    in_air += scene.distance_m(world) > 0.05 ? 1 : 0;
  }
  EXPECT_GT(in_air, (with.cloud.size() - without.cloud.size()) * 3 / 4);
}

TEST(Lidar, HasTheSameBitsForAnyNumberOfThreads) {
  ScannerOptions options;
  options.step_deg = 1;
  const RayCaster scene = room();
  const LidarScan one = scan_with(scene, kTilted, options, 1);
  for (const int threads : {2, 8}) {
    const LidarScan many = scan_with(scene, kTilted, options, threads);
    EXPECT_EQ(one.cloud.points, many.cloud.points);
    EXPECT_EQ(one.intensity, many.intensity);
  }
}

TEST(Lidar, RefusesOptionsOutOfBounds) {
  const auto refuses = [](auto change) {
    ScannerOptions options;
    change(options);
    EXPECT_THROW(options.validate(), InvalidOptions);
  };
  EXPECT_NO_THROW(ScannerOptions{}.validate());
  refuses([](ScannerOptions& o) { o.step_deg = 0; });
  refuses([](ScannerOptions& o) { o.step_deg = std::nan(""); });
  refuses([](ScannerOptions& o) { o.min_elevation_deg = 80; });
  refuses([](ScannerOptions& o) { o.max_elevation_deg = 91; });
  refuses([](ScannerOptions& o) { o.max_range_m = 0.1; });
  refuses([](ScannerOptions& o) { o.range_noise_m = -1; });
  refuses([](ScannerOptions& o) { o.angular_noise_deg = -1; });
  refuses([](ScannerOptions& o) { o.full_return_signal = 0; });
  refuses([](ScannerOptions& o) { o.thinning_voxel_m = -1; });
  refuses([](ScannerOptions& o) { o.isolated_share = 0.6; });
}

}  // namespace
}  // namespace tcm_icp
