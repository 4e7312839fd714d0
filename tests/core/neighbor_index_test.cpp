#include "tcm_icp/core/neighbor_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

std::vector<double> sorted_squared_distances(const Points& points, const Eigen::Vector3d& query) {
  std::vector<double> squared;
  for (const auto& p : points) squared.push_back((p - query).squaredNorm());
  std::sort(squared.begin(), squared.end());
  return squared;
}

TEST(NeighborIndex, AgreesWithLoopsOnDistances) {
  Rng rng = make_stream(1, "neighbor_index_test");
  const Points points = testing::random_points(2000, 10, rng);
  const NeighborIndex index(points);
  std::vector<Neighbor> found;
  for (const auto& q : testing::random_points(200, 14, rng)) {
    const auto expected = sorted_squared_distances(points, q);
    EXPECT_NEAR(index.nearest(q).squared_distance_m2, expected[0], 1e-12);
    index.nearest_k(q, 20, found);
    ASSERT_EQ(found.size(), 20u);
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_NEAR(found[i].squared_distance_m2, expected[i], 1e-12);
      EXPECT_NEAR((points[found[i].index] - q).squaredNorm(), expected[i], 1e-12);
    }
    const double radius = 1.5;
    index.within(q, radius, found);
    const auto end = std::upper_bound(expected.begin(), expected.end(), radius * radius);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(end - expected.begin()));
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i].squared_distance_m2, expected[i], 1e-12);
    const Neighbor near = index.nearest_within(q, radius);
    EXPECT_EQ(near.found(), expected[0] <= radius * radius);
    EXPECT_EQ(index.any_within(q, radius), near.found());
  }
}

TEST(NeighborIndex, SearchesThatKnowMoreFindTheSame) {
  Rng rng = make_stream(3, "neighbor_index_test");
  Points points = testing::random_points(2000, 10, rng);
  points.insert(points.end(), points.begin(), points.begin() + 500);  // equal distances, too
  const NeighborIndex index(points);
  const auto indices = [](const std::vector<Neighbor>& neighbors) {
    std::vector<std::uint32_t> out;
    for (const auto& n : neighbors) out.push_back(n.index);
    return out;
  };
  std::vector<Neighbor> plain, other;
  for (const auto& q : testing::random_points(200, 14, rng)) {
    index.nearest_k(q, 13, plain);
    for (const double factor : {1.0 + 1e-9, 1.5, 100.0}) {
      index.nearest_k_within(q, 13, factor * std::sqrt(plain.back().squared_distance_m2), other);
      EXPECT_EQ(indices(other), indices(plain)) << factor;
    }
    const double radius = 1.5;
    index.within(q, radius, plain);
    index.within_unordered(q, radius, other);
    auto in_order = indices(plain), unordered = indices(other);
    std::sort(in_order.begin(), in_order.end());
    std::sort(unordered.begin(), unordered.end());
    EXPECT_EQ(unordered, in_order);
    const Neighbor one = index.one_within(q, radius);
    ASSERT_EQ(one.found(), !plain.empty());
    if (!one.found()) continue;
    EXPECT_EQ(one.squared_distance_m2, squared_distance_m2(q, points[one.index]));
    EXPECT_LE(one.squared_distance_m2, radius * radius);
  }
}

TEST(NeighborIndex, EqualDistancesComeInTheOrderOfTheirIndices) {
  const NeighborIndex index(Points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  std::vector<Neighbor> found;
  index.nearest_k(Eigen::Vector3d::Zero(), 4, found);
  std::vector<std::uint32_t> indices;
  for (const auto& n : found) indices.push_back(n.index);
  EXPECT_EQ(indices, (std::vector<std::uint32_t>{3, 0, 1, 2}));
}

TEST(NeighborIndex, HoldsManyDuplicates) {
  const NeighborIndex index(Points(1000, Eigen::Vector3d(1, 2, 3)));
  std::vector<Neighbor> found;
  index.within({1, 2, 3}, 0.1, found);
  EXPECT_EQ(found.size(), 1000u);
  index.nearest_k({1, 2, 3}, 5, found);
  EXPECT_EQ(found.size(), 5u);
}

TEST(NeighborIndex, AsksForMoreThanThereAre) {
  const NeighborIndex index(Points{{0, 0, 0}, {1, 0, 0}});
  std::vector<Neighbor> found(7);
  index.nearest_k({0, 0, 0}, 5, found);
  EXPECT_EQ(found.size(), 2u);
  index.nearest_k({0, 0, 0}, 0, found);
  EXPECT_TRUE(found.empty());
}

TEST(NeighborIndex, FindsNothingWhereThereIsNothing) {
  const NeighborIndex index(Points{});
  std::vector<Neighbor> found(1);
  EXPECT_EQ(index.size(), 0u);
  EXPECT_FALSE(index.nearest({0, 0, 0}).found());
  EXPECT_FALSE(index.nearest_within({0, 0, 0}, 1).found());
  EXPECT_FALSE(index.any_within({0, 0, 0}, 1));
  index.nearest_k({0, 0, 0}, 3, found);
  EXPECT_TRUE(found.empty());
}

TEST(NeighborIndex, OutlivesItsInputAndMoves) {
  Points points{{0, 0, 0}, {5, 0, 0}};
  NeighborIndex first(points);
  points.clear();
  const NeighborIndex index(std::move(first));
  EXPECT_EQ(index.nearest({4, 0, 0}).index, 1u);
}

TEST(NeighborIndex, RefusesWhatIsNotFinite) {
  EXPECT_THROW(NeighborIndex(Points{{0, std::numeric_limits<double>::quiet_NaN(), 0}}), InvalidInput);
  EXPECT_THROW(NeighborIndex(Points{{0, 0, std::numeric_limits<double>::infinity()}}), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
