#include "tcm_icp/registration/normal_space_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <vector>

#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/place_sampling.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

std::vector<std::uint64_t> priorities_of(const Cloud& cloud, std::uint64_t seed) {
  Rng rng = make_stream(seed, "normal_space_sampling_test");
  return place_priorities(cloud.points, 0.1, rng);
}

constexpr std::size_t kFloor = 1900, kWalls = 100, kNone = 500;

// 95 % floor, 5 % of two walls, and points whose normal is not known.
Cloud floor_and_walls() {
  Cloud cloud;
  for (std::size_t i = 0; i < kFloor + kWalls + kNone; ++i) {
    cloud.points.emplace_back(static_cast<double>(i), 0, 0);
    if (i < kFloor) {
      cloud.normals.emplace_back(0, 0, i % 2 == 0 ? 1 : -1);
    } else if (i < kFloor + kWalls) {
      cloud.normals.push_back(i % 2 == 0 ? Vector3d::UnitX() : Vector3d::UnitY());
    } else {
      cloud.normals.push_back(Vector3d::Zero());
    }
  }
  return cloud;
}

TEST(NormalSpaceSample, AFloorOf95PercentGetsItsRootsShare) {
  const auto sample = normal_space_sample(floor_and_walls(), 200, priorities_of(floor_and_walls(), 1));
  EXPECT_EQ(sample.size(), 200u);
  const auto on_floor =
      static_cast<double>(std::count_if(sample.begin(), sample.end(), [](std::size_t i) { return i < kFloor; }));
  // sqrt(1900) of sqrt(1900) + 2 sqrt(50): 0.755
  EXPECT_NEAR(on_floor / 200, 0.755, 0.01);
}

TEST(NormalSpaceSample, GivesTheNumberAskedForInOrderWithoutRepeats) {
  Rng rng = make_stream(2, "normal_space_sampling_test");
  const Cloud cloud = testing::synthetic_scene({.num_scans = 1, .points_per_scan = 2000}, rng).scans[0];
  for (const std::size_t count : {0u, 1u, 47u, 500u, 1999u}) {
    const auto sample = normal_space_sample(cloud, count, priorities_of(cloud, 2));
    EXPECT_EQ(sample.size(), count);
    EXPECT_TRUE(std::is_sorted(sample.begin(), sample.end()));
    EXPECT_EQ(std::set<std::size_t>(sample.begin(), sample.end()).size(), sample.size());
  }
}

TEST(NormalSpaceSample, NeverDrawsAPointWithoutANormal) {
  for (const std::size_t count : {10u, 1000u, 100000u}) {
    const auto sample = normal_space_sample(floor_and_walls(), count, priorities_of(floor_and_walls(), 3));
    ASSERT_FALSE(sample.empty());
    EXPECT_LT(sample.back(), kFloor + kWalls);
    if (count > kFloor + kWalls) {
      EXPECT_EQ(sample.size(), kFloor + kWalls) << "all that have one";
    }
  }
}

TEST(NormalSpaceSample, SeedDecidesTheDraw) {
  const auto draw = [](std::uint64_t seed) {
    return normal_space_sample(floor_and_walls(), 100, priorities_of(floor_and_walls(), seed));
  };
  EXPECT_EQ(draw(4), draw(4));
  EXPECT_NE(draw(4), draw(5));
}

// What a rounding does: a point of one direction counts to another, or is none.
TEST(NormalSpaceSample, APointMoreOrLessChangesFewDraws) {
  const Cloud cloud = floor_and_walls();
  Cloud fewer = cloud;
  fewer.points.erase(fewer.points.begin() + 7);
  fewer.normals.erase(fewer.normals.begin() + 7);
  const auto places = [](const Cloud& c) {
    std::set<double> out;
    for (const std::size_t i : normal_space_sample(c, 200, priorities_of(c, 4))) out.insert(c.points[i].x());
    return out;
  };
  const std::set<double> before = places(cloud), after = places(fewer);
  std::vector<double> kept;
  std::set_intersection(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(kept));
  EXPECT_GE(kept.size(), 198u);
}

TEST(NormalSpaceSample, NothingGivesNothing) {
  EXPECT_TRUE(normal_space_sample({}, 10, {}).empty());
  const std::vector<std::uint64_t> one{7};
  EXPECT_TRUE(normal_space_sample({{{1, 2, 3}}, {}}, 10, one).empty()) << "a cloud without normals";
}

}  // namespace
}  // namespace tcm_icp
