#include "tcm_icp/visibility/point_density.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/matchers.hpp"
#include "support/room_scans.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

const Vector3d kStation = testing::spinner();

// A tripod scanner: equal steps in azimuth and elevation, but for the cone below.
Points rays_of_tripod_scanner(double step_deg = 0.75) {
  return testing::rays_of_steps(testing::tilted(), step_deg, step_deg, -60, 80 + step_deg / 2);
}

Cloud tripod_scan(const Vector3d& from = kStation) {
  return testing::with_range_noise(testing::scan_room(testing::furnished_room(), from, rays_of_tripod_scanner()), from,
                                   0.002);
}

DensitySamples densities_of(const Points& points, const std::vector<float>& counts) {
  Rng rng = make_stream(7, "point_density_test samples");
  return sample_densities(points, counts, NeighborIndex(points), rng);
}

DensitySamples densities_of(const Points& points) { return densities_of(points, std::vector<float>(points.size(), 1)); }

std::optional<Viewpoint> find_by_density(const Cloud& cloud, const DensitySamples& samples) {
  Rng rng = make_stream(7, "point_density_test");
  return find_viewpoint_by_density(cloud, samples, rng);
}

std::optional<Viewpoint> find_by_density(const Cloud& cloud) {
  return find_by_density(cloud, densities_of(cloud.points));
}

bool is_determined(const std::optional<Viewpoint>& found) { return found && found->determined(); }

Points square_grid(double step) {
  Points points;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) points.emplace_back(step * i, step * j, 0);
  }
  return points;
}

TEST(PointDensity, AGridGivesEachPointItsCell) {
  for (const double step : {0.001, 0.2, 50.0}) {
    const DensitySamples samples = densities_of(square_grid(step));
    ASSERT_GT(samples.points.size(), 1000u);
    std::vector<double> areas = samples.log_area;
    EXPECT_NEAR(median(areas), std::log(step * step), 0.1);
    for (const auto& n : samples.normals) EXPECT_NEAR(std::abs(n.z()), 1, 1e-9);
  }
}

TEST(PointDensity, APointThatStandsForThreeHasAThirdForEach) {
  const Points grid = square_grid(0.1);
  std::vector<double> one = densities_of(grid).log_area;
  std::vector<double> three = densities_of(grid, std::vector<float>(grid.size(), 3)).log_area;
  EXPECT_NEAR(median(one) - median(three), std::log(3), 1e-6);
}

TEST(PointDensity, EdgesAndTooFewPointsAreLeftOut) {
  Points corner = square_grid(0.1);
  for (const Vector3d& p : square_grid(0.1)) corner.emplace_back(-0.001, p.x(), p.y() + 0.1);
  for (const auto& n : densities_of(corner).normals) EXPECT_GT(n.cwiseAbs().maxCoeff(), 0.99);
  const Points few(corner.begin(), corner.begin() + 24);
  EXPECT_TRUE(densities_of(few).points.empty());
  EXPECT_TRUE(densities_of({}).points.empty());
}

TEST(ViewpointByDensity, IsWhereTheScannerStood) {
  for (const Vector3d& from : {kStation, Vector3d(6.8, 1.2, 1.2), Vector3d(1.2, 2.5, 2)}) {
    const auto found = find_by_density(tripod_scan(from));
    ASSERT_TRUE(found) << from.transpose();
    EXPECT_EQ(found->evidence, ViewpointEvidence::kDensity);
    EXPECT_TRUE(found->determined());
    EXPECT_LT((found->place - from).norm(), 0.1) << from.transpose();
    EXPECT_LT((found->place - from).norm(), 2 * found->radius_m) << from.transpose();
  }
}

TEST(ViewpointByDensity, EvenRaysOverTheSphereTellIt) {
  const auto found = find_by_density(testing::scan_room(testing::furnished_room(), kStation, 60'000));
  ASSERT_TRUE(is_determined(found));
  EXPECT_LT((found->place - kStation).norm(), 0.1);
}

TEST(ViewpointByDensity, MovesWithTheScanAndGrowsWithItsUnit) {
  const Cloud cloud = tripod_scan();
  Rng rng = make_stream(1, "point_density_test poses");
  for (const double unit : {0.001, 1.0, 1000.0}) {
    const Eigen::Isometry3d T = testing::scaled_pose(testing::random_pose(50, rng), unit);
    const auto found = find_by_density(transformed(testing::scaled_cloud(cloud, unit), T));
    ASSERT_TRUE(is_determined(found));
    EXPECT_LT((T.inverse() * found->place / unit - kStation).norm(), 0.1);
  }
}

TEST(ViewpointByDensity, WhatIsFarTellsItWhereAGridHasThinnedWhatIsNear) {
  const Cloud thinned = voxel_downsample(tripod_scan(), 0.06);
  ASSERT_LT(thinned.size(), 6 * tripod_scan().size() / 10);
  const auto found = find_by_density(thinned);
  ASSERT_TRUE(is_determined(found));
  EXPECT_LT((found->place - kStation).norm(), 0.15);
}

TEST(ViewpointByDensity, CountsTellWhatAThinnedCloudDoesNot) {
  const Cloud raw = tripod_scan();
  VoxelSampler sampler(8000);
  sampler.add(raw.points);
  const VoxelSample sample = sampler.finish();
  ASSERT_EQ(std::accumulate(sample.counts.begin(), sample.counts.end(), 0.0), static_cast<double>(raw.size()));
  const auto found = find_by_density(raw, densities_of(sample.points, sample.counts));
  ASSERT_TRUE(is_determined(found));
  EXPECT_LT((found->place - kStation).norm(), 0.15);
  EXPECT_FALSE(is_determined(find_by_density(raw, densities_of(sample.points)))) << "evenly thinned";
}

TEST(ViewpointByDensity, LostPointsMoveItLittle) {
  Rng rng = make_stream(3, "point_density_test lost");
  const Cloud all = tripod_scan();
  Cloud kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (uniform01(rng) < 0.7) continue;
    kept.points.push_back(all.points[i]);
    kept.normals.push_back(all.normals[i]);
  }
  const auto found = find_by_density(kept);
  ASSERT_TRUE(is_determined(found));
  EXPECT_LT((found->place - kStation).norm(), 0.15);
}

TEST(ViewpointByDensity, TwoScansMadeOneHaveNone) {
  Cloud both = tripod_scan();
  const Cloud other = tripod_scan({6.8, 1.2, 1.2});
  both.points.insert(both.points.end(), other.points.begin(), other.points.end());
  both.normals.insert(both.normals.end(), other.normals.begin(), other.normals.end());
  EXPECT_FALSE(is_determined(find_by_density(both)));
}

TEST(ViewpointByDensity, EvenlyCoveredSurfacesHaveNone) {
  EXPECT_FALSE(is_determined(find_by_density(voxel_downsample(tripod_scan(), 0.15))));
  Rng rng = make_stream(4, "point_density_test plane");
  Cloud plane;
  for (int i = 0; i < 5000; ++i) {
    plane.points.emplace_back(uniform01(rng), uniform01(rng), 0);
    plane.normals.push_back(Vector3d::UnitZ());
  }
  EXPECT_FALSE(is_determined(find_by_density(plane)));
}

// From below a floor its points lie as densely as from above.
TEST(ViewpointByDensity, IsOnTheSideOfTheFloorFromWhichNothingIsHidden) {
  testing::BoxRoom yard = testing::furnished_room();
  yard.walls = Eigen::AlignedBox3d(Vector3d(-12, -12, 0), Vector3d(20, 18, 50));
  Cloud scan;
  const Cloud all =
      testing::with_range_noise(testing::scan_room(yard, kStation, rays_of_tripod_scanner(0.5)), kStation, 0.002);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.points[i].z() > 3) continue;
    scan.points.push_back(all.points[i]);
    scan.normals.push_back(all.normals[i]);
  }
  const auto found = find_by_density(scan);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->place.z(), kStation.z(), 0.3);
}

TEST(ViewpointByDensity, IsNotLookedForWhereThereIsNothingToSee) {
  EXPECT_FALSE(find_by_density({}));
  const Cloud few = testing::scan_room(testing::furnished_room(), kStation, 150);
  EXPECT_FALSE(find_by_density(few));
  Cloud rough = tripod_scan();
  for (auto& n : rough.normals) n.setZero();
  EXPECT_FALSE(find_by_density(rough)) << "no surfaces";
}

TEST(ViewpointByDensity, TheSameNumbersGiveTheSameBits) {
  const Cloud cloud = tripod_scan();
  const auto a = find_by_density(cloud), b = find_by_density(cloud);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->place, b->place);
  EXPECT_EQ(a->radius_m, b->radius_m);
}

}  // namespace
}  // namespace tcm_icp
