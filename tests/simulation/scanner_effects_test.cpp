// What sensors other than a plain tripod do, and what they do wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "simulation/simple_scenes.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/lidar.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::ground;
using testing::room;
using testing::scan_with;

/// A sensor free of errors: each ray that meets something returns.
ScannerOptions ideal(SensorKind sensor) {
  ScannerOptions options = default_scanner(sensor);
  options.step_deg = 2;
  options.range_noise_m = options.angular_noise_deg = options.dropout_share = options.beam_width_deg = 0;
  options.thinning_voxel_m = options.isolated_share = options.min_range_m = 0;
  options.full_return_signal = 1e-9;
  options.max_incidence_deg = 90;
  return options;
}

double elevation_deg(const Vector3d& p) { return std::atan2(p.z(), p.head<2>().norm()) * 180 / M_PI; }

TEST(SpinningSensor, HasItsLinesEvenlyBetweenLowestAndHighest) {
  ScannerOptions options = ideal(SensorKind::kSpinning);
  for (const int lines : {16, 128}) {
    options.num_lines = lines;
    const LidarScan scan = scan_with(room(), Isometry3d::Identity(), options);
    EXPECT_EQ(scan.cloud.size(), 180u * static_cast<std::size_t>(lines));
    std::set<long> elevations;  // in thousandths of a degree
    for (const auto& p : scan.cloud.points) elevations.insert(std::lround(1000 * elevation_deg(p)));
    ASSERT_EQ(elevations.size(), static_cast<std::size_t>(lines));
    EXPECT_EQ(*elevations.begin(), std::lround(1000 * options.min_elevation_deg));
    EXPECT_EQ(*elevations.rbegin(), std::lround(1000 * options.max_elevation_deg));
  }
}

TEST(AerialSensor, SeesAStripBelowItsWay) {
  ScannerOptions options = ideal(SensorKind::kAerial);
  options.strip_length_m = 30;
  options.half_swath_deg = 45;
  const Isometry3d T(Translation3d(100, 0, 40) * Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
  const LidarScan scan = scan_with(ground(), T, options);
  Eigen::AlignedBox3d box;
  for (const auto& p : scan.cloud.points) box.extend(p);
  EXPECT_LT((box.min() - Vector3d(-15, -40, -40)).norm(), 1e-9);  // x along the flight, 45 degrees to either side
  EXPECT_NEAR(box.max().x(), 15, 1e-9);
  EXPECT_NEAR(box.max().z(), -40, 1e-9);
  EXPECT_NEAR(box.max().y(), 40, 2);  // a step of 2 degrees does not end at 45
  EXPECT_EQ(scan.cloud.size(), 121u * 46u);
}

TEST(ScannerEffects, DropoutsTakeTheirShareAndLeaveTheOthersAsTheyWere) {
  ScannerOptions options = ideal(SensorKind::kTerrestrial);
  options.range_noise_m = 0.01;
  const LidarScan all = scan_with(room(), Isometry3d::Identity(), options);
  options.dropout_share = 0.3;
  const LidarScan some = scan_with(room(), Isometry3d::Identity(), options);
  const double n = static_cast<double>(all.cloud.size());
  EXPECT_NEAR(static_cast<double>(some.cloud.size()), 0.7 * n, 4 * std::sqrt(0.21 * n));
  std::size_t at = 0;
  for (const auto& p : some.cloud.points) {
    while (at < all.cloud.size() && all.cloud.points[at] != p) ++at;
    ASSERT_LT(at, all.cloud.size()) << "a return that was not there without dropouts";
  }
}

TEST(ScannerEffects, SurfacesMetAtAGrazingAngleGiveNoReturn) {
  ScannerOptions options = ideal(SensorKind::kTerrestrial);
  const Isometry3d T(Translation3d(0, 0, 1.8));
  const LidarScan all = scan_with(ground(), T, options);
  options.max_incidence_deg = 75;
  const LidarScan some = scan_with(ground(), T, options);
  const double farthest_m = 1.8 / std::cos(75 * M_PI / 180);
  const auto near = std::count_if(all.cloud.points.begin(), all.cloud.points.end(),
                                  [&](const Vector3d& p) { return p.norm() <= farthest_m; });
  EXPECT_EQ(static_cast<std::ptrdiff_t>(some.cloud.size()), near);
  EXPECT_LT(some.cloud.size(), all.cloud.size());
}

/// A plate before a wall 10 m away; the share of returns that lie on neither.
double share_between(double gap_m, double beam_width_deg) {
  TriangleMesh mesh;
  add_quad(mesh, {10, -50, -50}, {10, 50, -50}, {10, 50, 50}, {10, -50, 50}, 1);
  add_quad(mesh, {10 - gap_m, -1, -1}, {10 - gap_m, 1, -1}, {10 - gap_m, 1, 1}, {10 - gap_m, -1, 1}, 1);
  ScannerOptions options = ideal(SensorKind::kTerrestrial);
  options.step_deg = 0.25;
  options.min_elevation_deg = -10;
  options.max_elevation_deg = 10;
  options.beam_width_deg = beam_width_deg;
  const LidarScan scan = scan_with(RayCaster(mesh), Isometry3d::Identity(), options);
  const auto between = std::count_if(scan.cloud.points.begin(), scan.cloud.points.end(), [&](const Vector3d& p) {
    return p.x() < 9.9 && p.x() > 10 - gap_m + 0.1 && p.head<2>().norm() < 11;
  });
  return static_cast<double>(between) / static_cast<double>(scan.cloud.size());
}

TEST(ScannerEffects, AWideBeamMixesSurfacesNearOneAnotherAndNoOthers) {
  EXPECT_EQ(share_between(0.6, 0), 0);
  EXPECT_GT(share_between(0.6, 0.5), 0.001);
  EXPECT_EQ(share_between(3, 0.5), 0);  // farther apart than a pulse: two returns, of which the first counts
}

TEST(ScannerEffects, MotionShiftsReturnsByUpToHalfTheWayOfATurn) {
  ScannerOptions options = ideal(SensorKind::kSpinning);
  const LidarScan still = scan_with(room(), Isometry3d::Identity(), options);
  options.speed_m_s = 5;
  options.turns_per_s = 10;  // half a metre a turn
  const LidarScan moving = scan_with(room(), Isometry3d::Identity(), options);
  const RayCaster walls = room();
  double largest = 0;
  for (const auto& p : moving.cloud.points) largest = std::max(largest, walls.distance_m(p));
  EXPECT_NEAR(largest, 0.25, 0.03);
  // The middle of the turn looks along -x and is where the scan is said to be.
  const auto ahead = [](const LidarScan& scan, std::size_t sweep) { return scan.cloud.points[sweep * 32 + 20].x(); };
  EXPECT_NEAR(ahead(moving, 90), ahead(still, 90), 1e-9);
  EXPECT_NEAR(ahead(moving, 0), ahead(still, 0) + 0.25,
              1e-9);  // still a quarter of a metre behind: the wall is farther
}

TEST(ScannerEffects, AnAerialSensorsMotionIsKnown) {
  ScannerOptions options = ideal(SensorKind::kAerial);
  options.speed_m_s = 50;
  for (const auto& p : scan_with(ground(), Isometry3d(Translation3d(0, 0, 40)), options).cloud.points)
    ASSERT_NEAR(p.z(), -40, 1e-9);
}

TEST(ScannerEffects, HaveTheSameBitsForAnyNumberOfThreads) {
  for (const SensorKind sensor : {SensorKind::kTerrestrial, SensorKind::kSpinning, SensorKind::kAerial}) {
    ScannerOptions options = default_scanner(sensor);
    options.step_deg = 2;
    options.min_range_m = 0.1;
    const RayCaster scene = room();
    Rng one = make_stream(3, "test"), four = make_stream(3, "test");
    const LidarScan a = simulate_scan(scene, Isometry3d::Identity(), options, one, 1);
    ASSERT_GT(a.cloud.size(), 500u);
    EXPECT_EQ(a.cloud.points, simulate_scan(scene, Isometry3d::Identity(), options, four, 4).cloud.points);
  }
}

TEST(ScannerEffects, AreRefusedOutOfBounds) {
  const auto refuses = [](auto change) {
    ScannerOptions options;
    change(options);
    EXPECT_THROW(options.validate(), InvalidOptions);
  };
  refuses([](ScannerOptions& o) { o.num_lines = 1; });
  refuses([](ScannerOptions& o) { o.half_swath_deg = 90; });
  refuses([](ScannerOptions& o) { o.line_spacing_m = 0; });
  refuses([](ScannerOptions& o) { o.strip_length_m = NAN; });
  refuses([](ScannerOptions& o) { o.max_incidence_deg = 0; });
  refuses([](ScannerOptions& o) { o.dropout_share = 1; });
  refuses([](ScannerOptions& o) { o.beam_width_deg = 2; });
  refuses([](ScannerOptions& o) { o.speed_m_s = NAN; });
  refuses([](ScannerOptions& o) { o.turns_per_s = 0; });
  for (const SensorKind kind : {SensorKind::kTerrestrial, SensorKind::kSpinning, SensorKind::kAerial}) {
    EXPECT_NO_THROW(default_scanner(kind).validate());
    EXPECT_EQ(sensor_kind_from_name(sensor_name(kind)), kind);
  }
  EXPECT_THROW(sensor_kind_from_name("sonar"), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
