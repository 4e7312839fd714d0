#include "scans/scan_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/temp_files.hpp"
#include "support/matchers.hpp"
#include "support/ply_file.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;
using testing::write_ply;

Points yard_points(std::uint64_t seed, std::size_t count, double noise_m = 0) {
  Rng rng = make_stream(seed, "scan_sampling_test");
  return testing::synthetic_scene({.num_scans = 1, .points_per_scan = count, .noise_m = noise_m}, rng).scans[0].points;
}

OutlierOptions keep_all() {
  OutlierOptions options;
  options.method = OutlierMethod::kNone;
  return options;
}

TEST(SampleScan, CountsPointsAndTakesTheFirstAsLocalOrigin) {
  const test::TempFolder folder;
  Points points = yard_points(1, 2000);
  const Vector3d utm(500'000, 5'000'000, 300);
  for (auto& p : points) p += utm;
  points[10].x() = std::numeric_limits<double>::quiet_NaN();
  points[20].z() = std::numeric_limits<double>::infinity();
  const SampledScan s = sample_scan(write_ply(folder.path() / "a.ply", points), {}, keep_all(), 42, 1);
  EXPECT_EQ(s.scan.file, "a.ply");
  EXPECT_EQ(s.scan.num_raw_points, 1998u);
  EXPECT_EQ(s.scan.num_dropped_points, 2u);
  EXPECT_EQ(s.scan.origin, points[0]);
  EXPECT_TRUE(testing::is_near(Vector3d::Zero(), s.scan.cloud.points[0], s.scan.voxel_size_m));
  EXPECT_TRUE(s.scan.cloud.has_normals());
  EXPECT_EQ(s.is_surface.size(), s.scan.cloud.size());
  for (const auto& p : s.scan.cloud.points) ASSERT_LT(p.norm(), 60) << "the yard is 24 m long";
  for (int axis = 0; axis < 3; ++axis) {
    const auto below = std::count_if(s.scan.cloud.points.begin(), s.scan.cloud.points.end(),
                                     [&](const Vector3d& p) { return p[axis] < s.middle[axis]; });
    EXPECT_NEAR(static_cast<double>(below), static_cast<double>(s.scan.cloud.size()) / 2, 1) << "axis " << axis;
  }
}

TEST(SampleScan, WorkingCloudIsBounded) {
  const test::TempFolder folder;
  SamplingOptions sampling;
  sampling.max_working_points = 1000;
  const SampledScan s =
      sample_scan(write_ply(folder.path() / "a.ply", yard_points(2, 8000)), sampling, keep_all(), 42, 1);
  EXPECT_LE(s.scan.cloud.size(), 1000u);
  EXPECT_GT(s.scan.cloud.size(), 100u);
  EXPECT_EQ(s.scan.num_raw_points, 8000u);
}

TEST(SampleScan, NoiseAndExtentAreMeasured) {
  const test::TempFolder folder;
  const auto noise_of = [&](double noise_m) {
    return sample_scan(write_ply(folder.path() / "a.ply", yard_points(3, 6000, noise_m)), {}, keep_all(), 42, 1).scan;
  };
  const Scan quiet = noise_of(0), noisy = noise_of(0.05);
  EXPECT_LT(quiet.noise_m, 0.005);
  EXPECT_GT(noisy.noise_m, 0.02);
  EXPECT_LT(noisy.noise_m, 0.1);
  EXPECT_GT(quiet.extent_m, 6);  // a scanner reaches 14 m
  EXPECT_LT(quiet.extent_m, 20);
}

// Lines 0.4 m apart on a wall, a point each 0.02 m, off it by 0.01 m: a point's nearest neighbours are of its own line,
// whose plane may be any through the line.
TEST(SampleScan, NormalsAreThoseOfSurfacesNotOfLinesOnThem) {
  const test::TempFolder folder;
  Rng rng = make_stream(6, "scan_sampling_test");
  const Eigen::Isometry3d T = testing::random_pose(5, rng);
  Points points;
  for (int line = 0; line < 20; ++line) {
    for (int k = 0; k < 400; ++k) points.push_back(T * Vector3d(0.02 * k, 0.4 * line, 0.01 * standard_normal(rng)));
  }
  const SampledScan s = sample_scan(write_ply(folder.path() / "a.ply", points), {}, keep_all(), 42, 1);
  EXPECT_GT(s.scan.coverage_m, 5 * s.scan.spacing_m);
  EXPECT_LT(s.scan.coverage_m, 0.8);
  std::size_t right = 0;
  for (std::size_t i = 0; i < s.scan.cloud.size(); ++i) {
    const bool is_right = std::abs(s.scan.cloud.normals[i].dot(T.linear().col(2))) > std::cos(0.15);
    right += is_right && s.is_surface[i] != 0 ? 1u : 0u;
  }
  EXPECT_GT(static_cast<double>(right) / static_cast<double>(s.scan.cloud.size()), 0.9);
}

// A room swept by sixteen lines, ranges noisier than neighbours on a line are apart: there a line covers the cone of
// its rays, which is smooth and no wall.
TEST(SampleScan, NormalsAreThoseOfWallsWhereLinesAreThickByNoise) {
  const test::TempFolder folder;
  constexpr double kNoise_m = 0.03, kDegree = EIGEN_PI / 180;
  const Vector3d half(2.5, 4, 1.5);  // of the room, from the scanner
  Rng rng = make_stream(8, "scan_sampling_test");
  const Eigen::Isometry3d T = testing::random_pose(5, rng);
  Points points, walls;
  for (int line = 0; line < 16; ++line) {
    for (int k = 0; k < 1800; ++k) {
      const double elevation = (2 * line - 15) * kDegree, azimuth = 0.2 * kDegree * k;
      const Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                         std::sin(elevation));
      Eigen::Index axis = 0;
      const double range = (half.array() / ray.array().abs()).minCoeff(&axis) + kNoise_m * standard_normal(rng);
      points.push_back(T * (range * ray));
      walls.push_back(T.linear().col(axis));
    }
  }
  const SampledScan s = sample_scan(write_ply(folder.path() / "a.ply", points), {}, keep_all(), 42, 1);
  EXPECT_GT(s.scan.noise_m, kNoise_m / 2) << "of the cone it is a tenth of a millimetre";
  EXPECT_LT(s.scan.noise_m, 1.5 * kNoise_m);
  EXPECT_GT(s.scan.coverage_m, 2 * kNoise_m);
  const NeighborIndex raw(points);
  std::size_t right = 0, along_axis = 0;
  for (std::size_t i = 0; i < s.scan.cloud.size(); ++i) {
    const Vector3d& n = s.scan.cloud.normals[i];
    right +=
        std::abs(n.dot(walls[raw.nearest(s.scan.cloud.points[i] + s.scan.origin).index])) > std::cos(0.4) ? 1u : 0u;
    along_axis += std::abs(n.dot(T.linear().col(2))) > std::cos(0.4) ? 1u : 0u;
  }
  const auto count = static_cast<double>(s.scan.cloud.size());
  EXPECT_GT(static_cast<double>(right) / count, 0.7);
  EXPECT_LT(static_cast<double>(along_axis) / count, 0.3) << "the lines hit hardly any floor";
}

TEST(SampleScan, RoughPlacesAreNoSurfaces) {
  const test::TempFolder folder;
  Rng rng = make_stream(4, "scan_sampling_test");
  Points points = yard_points(4, 3000);
  const std::size_t num_yard = points.size();
  for (int i = 0; i < 1000; ++i)
    points.push_back(Vector3d(40, 0, 0) + testing::random_pose(2, rng).translation());  // a bush
  const SampledScan s = sample_scan(write_ply(folder.path() / "a.ply", points), {}, keep_all(), 42, 1);
  std::size_t bush = 0, rough_bush = 0, walls = 0, rough_walls = 0;
  for (std::size_t i = 0; i < s.scan.cloud.size(); ++i) {
    const bool in_bush = (s.scan.cloud.points[i] + s.scan.origin - Vector3d(40, 0, 0)).norm() < 4;
    const bool rough = s.is_surface[i] == 0;
    (in_bush ? bush : walls) += 1;
    if (rough) (in_bush ? rough_bush : rough_walls) += 1;
  }
  ASSERT_GT(bush, 500u);
  ASSERT_GT(walls, num_yard / 2);
  EXPECT_GT(static_cast<double>(rough_bush) / static_cast<double>(bush), 0.6);
  EXPECT_LT(static_cast<double>(rough_walls) / static_cast<double>(walls), 0.4);
}

TEST(SampleScan, RefusesScansThatCannotBeRegisteredAndSaysWhy) {
  const test::TempFolder folder;
  const auto message = [&](const Points& points) {
    const auto path = write_ply(folder.path() / "bad.ply", points);
    return test::error_of<InvalidInput>([&] { sample_scan(path, {}, keep_all(), 42, 1); });
  };
  EXPECT_NE(message({{0, 0, 0}, {1, 0, 0}}).find("2 finite points"), std::string::npos);
  EXPECT_NE(message(Points(100, Vector3d(1, 2, 3))).find("1 place"), std::string::npos);
  EXPECT_NE(message({{0, 0, 0}, {1, 0, 0}}).find("bad.ply"), std::string::npos);
  EXPECT_THROW(sample_scan(folder.path() / "missing.ply", {}, keep_all(), 42, 1), InputError);
}

TEST(SampleScan, ThreadsAndRepeatsDoNotMatter) {
  const test::TempFolder folder;
  const auto path = write_ply(folder.path() / "a.ply", yard_points(5, 4000, 0.02));
  const SampledScan one = sample_scan(path, {}, {}, 42, 1), two = sample_scan(path, {}, {}, 42, 2);
  EXPECT_EQ(one.scan.cloud.points, two.scan.cloud.points);
  EXPECT_EQ(one.scan.cloud.normals, two.scan.cloud.normals);
  EXPECT_EQ(one.scan.noise_m, two.scan.noise_m);
}

}  // namespace
}  // namespace tcm_icp
