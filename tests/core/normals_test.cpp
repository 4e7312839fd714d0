#include "tcm_icp/core/normals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

TEST(Normals, OfATiltedPlaneAreItsOwnAndNothingIsRough) {
  Rng rng = make_stream(1, "normals_test");
  const Eigen::Vector3d normal = Eigen::Vector3d(1, -2, 2) / 3;
  Points points = testing::random_points(1000, 10, rng);
  for (auto& p : points) p -= normal * normal.dot(p);
  const NormalEstimate estimate = estimate_normals(points, NeighborIndex(points), {}, 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(std::abs(estimate.normals[i].dot(normal)), 1, 1e-9);
    EXPECT_NEAR(estimate.roughness_m[i], 0, 1e-6);  // a root of rounding at 1e-15 of a neighbourhood of 0.5 m
  }
}

TEST(Normals, OfASpherePointAlongTheRadius) {
  Rng rng = make_stream(2, "normals_test");
  Points points;
  for (int i = 0; i < 5000; ++i) {
    const double x = standard_normal(rng), y = standard_normal(rng), z = standard_normal(rng);
    points.push_back(Eigen::Vector3d(x, y, z).normalized());
  }
  const NormalEstimate estimate = estimate_normals(points, NeighborIndex(points), {}, 1);
  // Twelve neighbours span about 0.1 of the radius; lopsided ones tilt the plane by less than that.
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_GT(std::abs(estimate.normals[i].dot(points[i])), std::cos(0.1));
}

TEST(Normals, ALineHasNone) {
  Points line;
  for (int i = 0; i < 200; ++i) line.emplace_back(0.1 * i, 0, 0);
  for (const auto& n : estimate_normals(line, NeighborIndex(line), {}, 1).normals) EXPECT_TRUE(n.isZero(0));
}

// On a grid many neighbours are as far as the last one taken. In another unit, or far away, they come in another order.
TEST(Normals, OfAGridDoNotTurnByTheRoundingOfItsCoordinates) {
  Points grid;
  for (int x = 0; x < 30; ++x) {
    for (int y = 0; y < 30; ++y) grid.emplace_back(0.01 * x, 0.01 * y, 0.01 * ((7 * x + 3 * y) % 4));
  }
  const NormalEstimate here = estimate_normals(grid, NeighborIndex(grid), {}, 1);
  for (const auto& [scale, offset] : {std::pair(0.001, 0.0), std::pair(1000.0, 0.0), std::pair(1.0, 5e6)}) {
    Points moved;
    for (const auto& p : grid) moved.push_back((scale * p).array() + offset);
    const NormalEstimate there = estimate_normals(moved, NeighborIndex(moved), {}, 1);
    // Coordinates of 5 million are rounded by 1e-9, a spacing of 0.01 by 1e-7 of itself.
    for (std::size_t i = 0; i < grid.size(); ++i) {
      EXPECT_LT(here.normals[i].cross(there.normals[i]).norm(), 1e-6) << i << " times " << scale << " plus " << offset;
    }
  }
}

TEST(Normals, TheNumberOfThreadsDoesNotMatter) {
  Rng rng = make_stream(3, "normals_test");
  const Points points = testing::random_points(3000, 10, rng);
  const NeighborIndex index(points);
  const NormalEstimate one = estimate_normals(points, index, {}, 1);
  for (const int threads : {2, 8}) {
    const NormalEstimate many = estimate_normals(points, index, {}, threads);
    EXPECT_EQ(many.normals, one.normals);
    EXPECT_EQ(many.roughness_m, one.roughness_m);
  }
}

TEST(Normals, AtPlacesBesideThePointsAreThoseOfTheNearestPoints) {
  Rng rng = make_stream(5, "normals_test");
  Points plane, beside;
  for (int i = 0; i < 400; ++i) plane.emplace_back(10 * uniform01(rng), 10 * uniform01(rng), 0);
  for (int i = 0; i < 20; ++i) beside.emplace_back(10 * uniform01(rng), 10 * uniform01(rng), 0.5);
  const NormalEstimate at = estimate_normals_at(beside, plane, NeighborIndex(plane), {}, 1);
  ASSERT_EQ(at.normals.size(), beside.size());
  for (std::size_t i = 0; i < beside.size(); ++i) {
    EXPECT_NEAR(std::abs(at.normals[i].z()), 1, 1e-9);
    EXPECT_NEAR(at.roughness_m[i], 0, 1e-7) << "the root of what rounding leaves of an eigenvalue";
  }
}

TEST(Normals, RefuseBadOptions) {
  const NeighborIndex index(Points{});
  EXPECT_THROW(estimate_normals({}, index, {2, 48}, 1), InvalidOptions);
  EXPECT_THROW(estimate_normals({}, index, {12, 11}, 1), InvalidOptions);
}

TEST(MedianSpacing, IsTheMedianAndNotTheMean) {
  // Nearest others: 1, 1, 1, 1, 96.
  const Points points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {99, 0, 0}};
  EXPECT_DOUBLE_EQ(median_spacing(points, NeighborIndex(points)), 1);
  EXPECT_EQ(median_spacing({{1, 1, 1}}, NeighborIndex(Points{{1, 1, 1}})), 0);
  EXPECT_EQ(median_spacing({}, NeighborIndex(Points{})), 0);
}

}  // namespace
}  // namespace tcm_icp
