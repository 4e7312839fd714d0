#include "tcm_icp/core/place_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "support/random_points.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

constexpr double kVoxel = 0.25;

std::vector<std::uint64_t> priorities(const Points& points, std::uint64_t seed) {
  Rng rng = make_stream(seed, "place_sampling_test");
  return place_priorities(points, kVoxel, rng);
}

std::vector<std::size_t> all_of(const Points& points) {
  std::vector<std::size_t> out(points.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

class PlaceSampling : public ::testing::Test {
 protected:
  Rng rng = make_stream(1, "place_sampling_test");
  Points points = voxel_downsample({testing::random_points(20'000, 10, rng), {}}, kVoxel).points;
};

TEST_F(PlaceSampling, PrioritiesAreUniformAndOneAVoxel) {
  const auto p = priorities(points, 1);
  EXPECT_EQ(std::set<std::uint64_t>(p.begin(), p.end()).size(), points.size());
  std::vector<int> tenths(10);
  for (const std::uint64_t x : p) ++tenths[static_cast<std::size_t>(static_cast<double>(x) * 0x1p-64 * 10)];
  const double expected = static_cast<double>(points.size()) / 10;
  for (const int n : tenths) EXPECT_NEAR(n, expected, 5 * std::sqrt(expected));
}

// Neighbouring voxels differ by one in one number: the draw must not follow the grid.
TEST_F(PlaceSampling, ADrawDoesNotFollowTheGrid) {
  Points grid;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) grid.emplace_back(kVoxel * (i + 0.5), kVoxel * (j + 0.5), 0.1);
  }
  const auto drawn = least_priorities(all_of(grid), priorities(grid, 1), 400);
  std::vector<int> rows(40), columns(40);
  for (const std::size_t i : drawn) {
    ++rows[i / 40];
    ++columns[i % 40];
  }
  for (const auto& lines : {rows, columns}) {
    EXPECT_LT(*std::max_element(lines.begin(), lines.end()), 10 + 5 * 3);
    EXPECT_GT(*std::min_element(lines.begin(), lines.end()), 0);
  }
}

TEST_F(PlaceSampling, DrawsTheNumberAskedForInOrder) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{100}, points.size(), points.size() + 1}) {
    const auto drawn = least_priorities(all_of(points), priorities(points, 1), count);
    EXPECT_EQ(drawn.size(), std::min(count, points.size()));
    EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
    EXPECT_EQ(std::adjacent_find(drawn.begin(), drawn.end()), drawn.end());
  }
}

TEST_F(PlaceSampling, ASmallerDrawIsTheBeginningOfTheOrder) {
  const auto p = priorities(points, 1);
  std::vector<std::size_t> order = draw_order(p);
  order.resize(50);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(least_priorities(all_of(points), p, 50), order);
}

TEST_F(PlaceSampling, TheSeedDecides) {
  EXPECT_EQ(priorities(points, 2), priorities(points, 2));
  const auto a = least_priorities(all_of(points), priorities(points, 2), 300);
  const auto b = least_priorities(all_of(points), priorities(points, 3), 300);
  std::vector<std::size_t> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  const double expected = 300.0 * 300.0 / static_cast<double>(points.size());
  EXPECT_NEAR(static_cast<double>(both.size()), expected, 5 * std::sqrt(expected)) << "seeds draw independently";
}

// With drawn indices all draws after the missing point would be others.
TEST_F(PlaceSampling, AMissingPointChangesOneDraw) {
  const auto places = [](const Points& of) {
    std::set<std::vector<double>> out;
    for (const std::size_t i : least_priorities(all_of(of), priorities(of, 1), 300)) {
      out.insert({of[i].x(), of[i].y(), of[i].z()});
    }
    return out;
  };
  Points fewer = points;
  fewer.erase(fewer.begin() + 5);
  const auto before = places(points), after = places(fewer);
  std::vector<std::vector<double>> lost;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(lost));
  EXPECT_LE(lost.size(), 1u);
}

TEST(RoundedVoxelSize, IsNearAndStaysWhereMeasurementsDifferByARounding) {
  for (const double size : {1e-4, 0.0123, 0.5, 1.0, 77.7}) {
    const double rounded = rounded_voxel_size(size);
    EXPECT_NEAR(std::log10(rounded / size), 0, 0.5 / 31 + 1e-12);
    EXPECT_EQ(rounded_voxel_size(rounded), rounded);
    EXPECT_EQ(rounded_voxel_size(rounded * (1 + 1e-3)), rounded);
  }
  EXPECT_EQ(rounded_voxel_size(0), 0);
}

TEST(RoundedVoxelSize, TheUnitDecidesNothing) {
  for (const double metres : {0.0123, 0.5, 3.3}) {
    EXPECT_NEAR(rounded_voxel_size(1000 * metres), 1000 * rounded_voxel_size(metres), 1e-9 * metres);
    EXPECT_NEAR(rounded_voxel_size(metres / 0.3048) * 0.3048 / rounded_voxel_size(metres), 1, 4e-4);
  }
}

}  // namespace
}  // namespace tcm_icp
