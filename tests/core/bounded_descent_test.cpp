// The walk behind NeighborIndex, bit for bit against a loop over all points.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// All points by distance and then index, each distance summed in the order x, y, z: equal to the index's bit for bit.
std::vector<Neighbor> sorted_by_loop(const Points& points, const Eigen::Vector3d& q) {
  std::vector<Neighbor> out;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d d = q - points[i];
    out.push_back({i, d.x() * d.x() + d.y() * d.y() + d.z() * d.z()});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Neighbor& a, const Neighbor& b) { return a.squared_distance_m2 < b.squared_distance_m2; });
  return out;
}

void expect_equal(const std::vector<Neighbor>& found, std::vector<Neighbor> expected, std::size_t count) {
  ASSERT_LE(count, expected.size());
  expected.resize(count);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(found[i].index, expected[i].index) << "neighbour " << i;
    EXPECT_EQ(found[i].squared_distance_m2, expected[i].squared_distance_m2) << "neighbour " << i;
  }
}

// Every kind of query against the loop; radii meet points exactly, and reach from none to all of them.
void expect_answers_of_loop(const Points& points, const Points& queries) {
  const NeighborIndex index(points);
  std::vector<Neighbor> found;
  for (const auto& q : queries) {
    const auto all = sorted_by_loop(points, q);
    expect_equal({index.nearest(q)}, all, 1);
    for (const std::size_t k : {std::size_t{1}, std::size_t{7}, points.size(), points.size() + 5}) {
      index.nearest_k(q, k, found);
      expect_equal(found, all, std::min(k, points.size()));
    }
    for (const std::size_t i : {std::size_t{0}, points.size() / 3, points.size() - 1}) {
      for (const double factor : {0.999, 1.0, 1.001}) {
        const double radius_m = factor * std::sqrt(all[i].squared_distance_m2);
        const auto outside = std::find_if(
            all.begin(), all.end(), [&](const Neighbor& n) { return n.squared_distance_m2 > radius_m * radius_m; });
        const auto count = static_cast<std::size_t>(outside - all.begin());
        index.within(q, radius_m, found);
        expect_equal(found, all, count);
        const Neighbor n = index.nearest_within(q, radius_m);
        ASSERT_EQ(n.found(), count > 0);
        if (n.found()) expect_equal({n}, all, 1);
      }
    }
  }
}

Eigen::Vector3d uniform_in_box(Rng& rng, const Eigen::Vector3d& size) {
  return {size.x() * uniform01(rng), size.y() * uniform01(rng), size.z() * uniform01(rng)};
}

Points random_points(std::size_t count, const Eigen::Vector3d& size, const Eigen::Vector3d& offset = {0, 0, 0}) {
  Rng rng = make_stream(1, "neighbour index test");
  Points out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(offset + uniform_in_box(rng, size));
  return out;
}

// Inside, near and far outside the points, and on some of them.
Points queries_around(const Points& points) {
  Rng rng = make_stream(2, "neighbour index test");
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(p);
  const Eigen::Vector3d size = (box.max() - box.min()).array() + 1;
  Points out{points.front(), points.back(), box.center() + 1000 * size};
  for (int i = 0; i < 25; ++i) out.push_back(box.min() - size + uniform_in_box(rng, 3 * size));
  return out;
}

TEST(BoundedDescent, AnswersAsALoopDoesInAVolume) {
  const Points points = random_points(700, {10, 7, 3});
  expect_answers_of_loop(points, queries_around(points));
}

TEST(BoundedDescent, AnswersAsALoopDoesOnAPlaneAndALine) {
  const Points plane = random_points(500, {20, 0, 9}), line = random_points(500, {0, 30, 0});
  expect_answers_of_loop(plane, queries_around(plane));
  expect_answers_of_loop(line, queries_around(line));
}

TEST(BoundedDescent, AnswersAsALoopDoesAtCoordinatesOfAMap) {
  const Points points = random_points(500, {40, 40, 5}, {5.4e6, 3.6e5, 120});
  expect_answers_of_loop(points, queries_around(points));
}

TEST(BoundedDescent, PrefersTheLowestIndexAmongEqualsOnAGrid) {
  // Centres of cells are as far from eight corners, and the shuffled order is not the tree's.
  Points grid, queries;
  for (int i = 0; i < 512; ++i) {
    const int j = i * 37 % 512;  // a permutation, 37 and 512 having no common divisor
    grid.push_back(Eigen::Vector3d(j % 8, j / 8 % 8, j / 64));
  }
  for (int i = 0; i < 7; ++i) queries.push_back(Eigen::Vector3d(i, 6 - i, i).array() + 0.5);
  queries.push_back({3, 3, 3.5});
  ASSERT_EQ(sorted_by_loop(grid, queries[0])[7].squared_distance_m2, 0.75);
  expect_answers_of_loop(grid, queries);
}

TEST(BoundedDescent, AnswersAsALoopDoesAmongDuplicates) {
  const Points same(100, Eigen::Vector3d(1, 2, 3));
  expect_answers_of_loop(same, queries_around(same));
  const Points once = random_points(300, {5, 5, 5});
  Points twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  expect_answers_of_loop(twice, queries_around(twice));
}

TEST(BoundedDescent, AnswersForOnePoint) {
  const Points one{{-4, 5, 0.5}};
  expect_answers_of_loop(one, queries_around(one));
}

TEST(BoundedDescent, FindsNothingForAQueryThatIsNotFinite) {
  const NeighborIndex index(random_points(100, {1, 1, 1}));
  std::vector<Neighbor> found(3);
  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    for (const Eigen::Vector3d& q :
         {Eigen::Vector3d(bad, 0, 0), Eigen::Vector3d(0, bad, 0), Eigen::Vector3d(0, 0, bad)}) {
      EXPECT_FALSE(index.nearest(q).found());
      EXPECT_FALSE(index.nearest_within(q, 1).found());
      index.nearest_k(q, 3, found);
      EXPECT_TRUE(found.empty());
      index.within(q, kInfinity, found);
      EXPECT_TRUE(found.empty());
    }
  }
}

TEST(BoundedDescent, AnInfiniteRadiusLeavesNothingOut) {
  const Points points = random_points(200, {1, 1, 1});
  const NeighborIndex index(points);
  std::vector<Neighbor> found;
  index.within({3, 3, 3}, kInfinity, found);
  expect_equal(found, sorted_by_loop(points, {3, 3, 3}), points.size());
  EXPECT_EQ(index.nearest_within({3, 3, 3}, kInfinity).index, found.front().index);
}

}  // namespace
}  // namespace tcm_icp
