#include "tcm_icp/core/grid_index.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity(), kNotANumber = std::nan("");

// CGAL's tree is the reference: index and bits.
std::size_t expect_what_the_tree_finds(const Points& points, double cell_m, const Points& queries, double radius_m) {
  const GridIndex grid(points, cell_m);
  const NeighborIndex tree(points);
  std::size_t num_found = 0;
  for (const auto& q : queries) {
    const Neighbor expected = tree.nearest_within(q, radius_m), found = grid.nearest_within(q, radius_m);
    EXPECT_EQ(found.index, expected.index) << q.transpose() << ", radius " << radius_m;
    EXPECT_EQ(found.squared_distance_m2, expected.squared_distance_m2);
    num_found += found.found() ? 1 : 0;
  }
  return num_found;
}

Points lattice(int per_axis, double step_m) {
  Points points;
  for (int i = 0; i < per_axis * per_axis * per_axis; ++i) {
    points.emplace_back(i % per_axis, i / per_axis % per_axis, i / per_axis / per_axis);
    points.back() *= step_m;
  }
  return points;
}

TEST(GridIndex, FindsWhatATreeFindsAtAnyRadius) {
  Rng rng = make_stream(1, "grid_index_test");
  const Points points = testing::random_points(3000, 10, rng), queries = testing::random_points(400, 14, rng);
  std::size_t before = 0;
  for (const double radius_m : {0.2, 0.7, 1.5, 4.0, 60.0, kInfinite}) {
    const std::size_t found = expect_what_the_tree_finds(points, 1.5, queries, radius_m);
    EXPECT_GE(found, before);
    before = found;
  }
  EXPECT_EQ(before, queries.size());
}

TEST(GridIndex, OfEquallyNearPointsTheLowestIndexIsNearer) {
  Points points = lattice(6, 1);
  points.insert(points.end(), points.begin(), points.begin() + 100);
  Points middles = lattice(11, 0.5);  // of cells, faces, edges and on points
  EXPECT_EQ(expect_what_the_tree_finds(points, 2, middles, 1), middles.size());
  EXPECT_EQ(expect_what_the_tree_finds(points, 1, middles, 0.9), middles.size());
  expect_what_the_tree_finds(points, 1, middles, 0.5);  // exactly the radius away
}

TEST(GridIndex, IsExactFarFromTheOrigin) {
  Rng rng = make_stream(2, "grid_index_test");
  for (const double far_m : {1e6, 1e9}) {
    Points points = lattice(12, 0.25), queries = testing::random_points(200, 3, rng);
    for (auto& p : points) p += Eigen::Vector3d(far_m, -3 * far_m, 7);
    for (auto& q : queries) q += Eigen::Vector3d(far_m, -3 * far_m, 7);
    EXPECT_GT(expect_what_the_tree_finds(points, 0.25, queries, 0.25), 20u);
    EXPECT_GT(expect_what_the_tree_finds(points, 0.7, queries, 0.5), 20u);
  }
}

TEST(GridIndex, CellsThatShareABucketStayApart) {
  // 1024 cells apart: the same place, where places wrap around.
  Points points = lattice(5, 0.3);
  const std::size_t num_here = points.size();
  for (std::size_t i = 0; i < num_here; ++i) points.push_back(points[i] + Eigen::Vector3d(1024, 0, 2048));
  Rng rng = make_stream(3, "grid_index_test");
  Points queries = testing::random_points(100, 2, rng);
  for (std::size_t i = 0; i < 100; ++i) queries.push_back(queries[i] + Eigen::Vector3d(1024, 0, 2048));
  for (std::size_t i = 0; i < 100; ++i) queries.push_back(queries[i] + Eigen::Vector3d(1024, 0, 1024));  // nobody's
  expect_what_the_tree_finds(points, 1, queries, 1);
  expect_what_the_tree_finds(points, 1, queries, 3);
}

TEST(GridIndex, QueriesThatAreNoneFindNothing) {
  const Points points{{0, 0, 0}, {1, 0, 0}};
  const GridIndex grid(points, 1), empty(Points{}, 1);
  EXPECT_EQ(empty.size(), 0u);
  EXPECT_FALSE(empty.nearest_within({0, 0, 0}, 1).found());
  for (const double x : {kNotANumber, kInfinite, -kInfinite}) {
    EXPECT_FALSE(grid.nearest_within({x, 0, 0}, 1).found());
    EXPECT_FALSE(grid.nearest_within({0, 0, x}, kInfinite).found());
  }
  EXPECT_FALSE(grid.nearest_within({0.5, 0, 0}, 0.4).found());
  EXPECT_FALSE(grid.nearest_within({1e300, 0, 0}, 1).found());
  EXPECT_EQ(grid.nearest_within({1e12, 0, 0}, kInfinite).index, 1u);
  EXPECT_EQ(grid.nearest_within({0.5, 0, 0}, 0.5).index, 0u);
}

TEST(GridIndex, CopiesAnswerForThemselves) {
  const Points points{{0, 0, 0}, {1, 0, 0}};
  auto grid = std::make_unique<GridIndex>(points, 1);
  const GridIndex copy = *grid;
  grid.reset();
  EXPECT_EQ(copy.nearest_within({0.9, 0, 0}, 1).index, 1u);
}

TEST(GridIndex, RefusesWhatIsNotFiniteAndCellsThatAreNone) {
  const Points one{{0, 0, 0}};
  EXPECT_THROW(GridIndex(Points({{0, kNotANumber, 0}}), 1), InvalidInput);
  EXPECT_THROW(GridIndex(Points({{0, 0, kInfinite}}), 1), InvalidInput);
  for (const double cell_m : {0.0, -1.0, kNotANumber, kInfinite, 1e-320}) {
    EXPECT_THROW(GridIndex(one, cell_m), InvalidOptions) << cell_m;
  }
}

}  // namespace
}  // namespace tcm_icp
