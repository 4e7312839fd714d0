#include "tcm_icp/registration/normal_space_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/synthetic_scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

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
  Rng rng = make_stream(1, "normal_space_sampling_test");
  const auto sample = normal_space_sample(floor_and_walls(), 200, rng);
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
    const auto sample = normal_space_sample(cloud, count, rng);
    EXPECT_EQ(sample.size(), count);
    EXPECT_TRUE(std::is_sorted(sample.begin(), sample.end()));
    EXPECT_EQ(std::set<std::size_t>(sample.begin(), sample.end()).size(), sample.size());
  }
}

TEST(NormalSpaceSample, NeverDrawsAPointWithoutANormal) {
  Rng rng = make_stream(3, "normal_space_sampling_test");
  for (const std::size_t count : {10u, 1000u, 100000u}) {
    const auto sample = normal_space_sample(floor_and_walls(), count, rng);
    ASSERT_FALSE(sample.empty());
    EXPECT_LT(sample.back(), kFloor + kWalls);
    if (count > kFloor + kWalls) {
      EXPECT_EQ(sample.size(), kFloor + kWalls) << "all that have one";
    }
  }
}

TEST(NormalSpaceSample, SeedDecidesTheDraw) {
  const auto draw = [](std::uint64_t seed) {
    Rng rng = make_stream(seed, "normal_space_sampling_test");
    return normal_space_sample(floor_and_walls(), 100, rng);
  };
  EXPECT_EQ(draw(4), draw(4));
  EXPECT_NE(draw(4), draw(5));
}

TEST(NormalSpaceSample, NothingGivesNothing) {
  Rng rng = make_stream(6, "normal_space_sampling_test");
  EXPECT_TRUE(normal_space_sample({}, 10, rng).empty());
  EXPECT_TRUE(normal_space_sample({{{1, 2, 3}}, {}}, 10, rng).empty()) << "a cloud without normals";
}

}  // namespace
}  // namespace tcm_icp
