#include "pipeline/voxel_thinner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

Points some_points(std::size_t count) {
  Rng rng = make_stream(3, "thinned");
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(5e6 + 20 * uniform01(rng), -20 * uniform01(rng), 20 * uniform01(rng) - 10);
  }
  return points;
}

TEST(VoxelThinner, TakesTheFirstPointOfEachVoxelAsALoopDoes) {
  std::set<std::array<double, 3>> seen;
  VoxelThinner thinner(0.7);
  for (const auto& p : some_points(30000)) {
    const bool is_first =
        seen.insert({std::floor(p.x() / 0.7), std::floor(p.y() / 0.7), std::floor(p.z() / 0.7)}).second;
    ASSERT_EQ(thinner.takes(p), is_first);
  }
  EXPECT_EQ(thinner.num_voxels(), seen.size());
  EXPECT_LT(seen.size(), 29000U);
  EXPECT_GT(seen.size(), 2000U);  // the table has grown
}

TEST(VoxelThinner, PartsTogetherTakeTheSamePoints) {
  const Points points = some_points(20000);
  VoxelThinner whole(0.7);
  std::vector<int> expected, found(points.size(), 0);
  for (const auto& p : points) expected.push_back(whole.takes(p) ? 1 : 0);
  std::uint64_t most = 0;
  for (std::uint64_t part = 0; part < 5; ++part) {
    VoxelThinner thinner(0.7, part, 5);
    for (std::size_t i = 0; i < points.size(); ++i) found[i] += thinner.takes(points[i]) ? 1 : 0;
    most = std::max(most, thinner.num_voxels());
  }
  EXPECT_EQ(found, expected);
  EXPECT_LT(most, whole.num_voxels() / 4);  // parts are about equal
}

TEST(VoxelThinner, VoxelsThatCannotBeNumberedAreRefused) {
  EXPECT_THROW(VoxelThinner(1e-12).takes({5e6, 0, 0}), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
