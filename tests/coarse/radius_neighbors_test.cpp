#include "coarse/radius_neighbors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_points.hpp"

namespace tcm_icp {
namespace {

std::vector<std::uint32_t> by_loop(const Points& points, std::size_t i, double radius_m) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t j = 0; j < points.size(); ++j) {
    if (j != i && (points[j] - points[i]).squaredNorm() <= radius_m * radius_m) out.push_back(j);
  }
  return out;
}

void expect_same_as_by_loop(const Points& points, double radius_m) {
  const RadiusNeighbors neighbors = radius_neighbors(points, radius_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto found = neighbors.of(i);
    std::vector<std::uint32_t> sorted(found.begin(), found.end());
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(by_loop(points, i, radius_m), sorted) << "point " << i;
  }
}

TEST(RadiusNeighbors, AreThoseThatALoopFinds) {
  Rng rng = make_stream(1, "radius neighbours");
  for (const double radius_m : {0.3, 1.0, 7.0}) expect_same_as_by_loop(testing::random_points(400, 10, rng), radius_m);
}

TEST(RadiusNeighbors, EqualPointsAreNeighborsOfEachOther) { expect_same_as_by_loop(Points(5, {1, 2, 3}), 0.5); }

TEST(RadiusNeighbors, OfNoPointsAreNone) { EXPECT_TRUE(radius_neighbors({}, 1).index.empty()); }

}  // namespace
}  // namespace tcm_icp
