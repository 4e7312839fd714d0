#include "tcm_icp/core/voxel_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/normals.hpp"

namespace tcm_icp {
namespace {

TEST(VoxelKey, RoundsDownOnBothSidesOfZeroAndHasNoOverflow) {
  EXPECT_EQ(voxel_key({0.9, -0.1, 2.0}, 1), (VoxelKey{0, -1, 2}));
  EXPECT_EQ(voxel_key({1e300, -1e300, 0}, 1), voxel_key({1e301, -1e301, 0}, 1));
}

TEST(VoxelSampler, IsBoundedAndKeepsTheMean) {
  Rng rng = make_stream(1, "voxel_test");
  const Points points = testing::random_points(20000, 10, rng);
  VoxelSampler sampler(500);
  sampler.add(points);
  const double size = sampler.voxel_size_m();
  const auto [sample, counts] = sampler.finish();
  ASSERT_EQ(counts.size(), sample.size());
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0), 20000);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), kept = mean;
  for (const auto& p : points) mean += p / 20000;
  for (std::size_t i = 0; i < sample.size(); ++i) kept += counts[i] * sample[i] / 20000;
  EXPECT_LT((kept - mean).norm(), 1e-9);
  EXPECT_LE(sample.size(), 500u);
  EXPECT_GT(sample.size(), 500u / 8);  // one doubling of the voxel takes at most an eighth
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> keys;
  for (const auto& p : sample) {
    const VoxelKey key = voxel_key(p, size);
    keys.emplace(key.x, key.y, key.z);
  }
  // One point to a voxel, but for a few that joining moved over a border.
  EXPECT_GE(keys.size(), sample.size() - sample.size() / 50);
}

TEST(VoxelSampler, BlocksOfTheStreamDoNotMatterOnceTheVoxelIsChosen) {
  Rng rng = make_stream(2, "voxel_test");
  const Points points = testing::random_points(5000, 10, rng);
  const std::span<const Eigen::Vector3d> all(points);
  VoxelSampler one(300), many(300);
  one.add(all.first(1000));
  one.add(all.subspan(1000));
  many.add(all.first(1000));
  for (std::size_t i = 1000; i < points.size(); i += 100) many.add(all.subspan(i, 100));
  EXPECT_EQ(one.finish().points, many.finish().points);
}

TEST(VoxelSampler, ScalesWithTheCloud) {
  Rng rng = make_stream(3, "voxel_test");
  const Points points = testing::random_points(5000, 10, rng);
  VoxelSampler small(300), large(300);
  small.add(points);
  large.add(testing::scaled(points, 1024));
  EXPECT_EQ(large.voxel_size_m(), 1024 * small.voxel_size_m());
  EXPECT_EQ(large.finish().points, testing::scaled(small.finish().points, 1024));
}

// Each place is seen many times, as by a scanner that stands still: voxel borders run through many of them.
TEST(VoxelSampler, APlaceSplitByVoxelBordersIsOnePoint) {
  Rng rng = make_stream(4, "voxel_test");
  const Points places = testing::random_points(400, 10, rng);
  Points points;
  for (int repeat = 0; repeat < 50; ++repeat) {
    for (const auto& p : testing::random_points(places.size(), 0.05, rng)) {
      points.push_back(places[points.size() % places.size()] + p);
    }
  }
  VoxelSampler sampler(1500);
  sampler.add(points);
  const Points sample = sampler.finish().points;
  const double voxel_m = sampler.voxel_size_m();
  ASSERT_GT(voxel_m, 0.1);                                          // it grew beyond what the jitter spans
  ASSERT_GT(count_voxels(points, voxel_m), 6 * places.size() / 5);  // and its borders do split places
  EXPECT_LT(sample.size(), places.size() + places.size() / 20);
  EXPECT_GT(median_spacing(sample, NeighborIndex(sample)), voxel_m / 2);
  const NeighborIndex index(sample);
  for (const auto& p : places) EXPECT_TRUE(index.any_within(p, voxel_m));
}

TEST(VoxelSampler, EqualPointsAreOne) {
  VoxelSampler sampler(8);
  sampler.add(Points(100, Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(sampler.voxel_size_m(), 0);
  const auto [points, counts] = sampler.finish();
  EXPECT_EQ(points, (Points{{1, 2, 3}}));
  EXPECT_EQ(counts, std::vector<float>{100});
}

TEST(VoxelSampler, NothingGivesNothingAndSevenVoxelsAreTooFew) {
  VoxelSampler sampler(8);
  sampler.add({});
  EXPECT_TRUE(sampler.finish().points.empty());
  EXPECT_THROW(VoxelSampler(7), InvalidOptions);
}

TEST(VoxelDownsample, TakesTheMeanOfEachVoxelInOrderOfAppearance) {
  const Cloud sample = voxel_downsample({{{1.2, 0.5, 0.5}, {0.2, 0.5, 0.5}, {1.6, 0.5, 0.5}}, {}}, 1);
  EXPECT_TRUE(testing::are_points_near({{1.4, 0.5, 0.5}, {0.2, 0.5, 0.5}}, sample.points, 1e-15));
}

TEST(VoxelDownsample, NormalsOfOppositeSignAreTheSameSurface) {
  const Cloud sample = voxel_downsample({{{0.5, 0.5, 0.5}, {0.6, 0.5, 0.5}}, {{0, 0, 1}, {0, 0, -1}}}, 1);
  ASSERT_EQ(sample.normals.size(), 1u);
  EXPECT_NEAR(std::abs(sample.normals[0].z()), 1, 1e-15);
}

// Two points are as far from their mean, whatever rounding says.
TEST(VoxelDownsample, OfTwoPointsTheFirstGivesTheNormalsSign) {
  Rng rng = make_stream(5, "voxel_sampler_test");
  for (int i = 0; i < 200; ++i) {
    const Points two{testing::random_points(1, 0.5, rng).front(), testing::random_points(1, 0.5, rng).front()};
    Cloud cloud{{}, {Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitX()}};
    for (const auto& p : two) cloud.points.emplace_back(p.array() + 2);
    const Cloud sample = voxel_downsample(cloud, 4);
    ASSERT_EQ(sample.size(), 1u);
    EXPECT_NEAR(sample.normals[0].x(), 1, 1e-15);
  }
}

}  // namespace
}  // namespace tcm_icp
