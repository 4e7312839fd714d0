#include "tcm_icp/coarse/height_map.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp::testing {
namespace {

// Two points over each square metre of a plateau with one tower.
Points plateau() {
  Points points;
  for (int x = -20; x <= 20; ++x) {
    for (int y = -15; y <= 15; ++y) {
      points.emplace_back(x, y, 1);
      points.emplace_back(x, y, x == 5 && y == 3 ? 9 : 2);
    }
  }
  return points;
}

TEST(HeightMap, KeepsTheHighestPointOfACell) {
  const Points points = plateau();
  const Footprint footprint = find_footprint(points, Eigen::Vector3d::UnitZ());
  const HeightMap map = make_height_map({points, {}}, footprint, 1.0);
  const Eigen::Vector3d tower = map.T_map_scan * Eigen::Vector3d(5, 3, 9);
  const auto column = static_cast<int>(std::lround(tower.x())) + map.size / 2;
  const auto row = static_cast<int>(std::lround(tower.y())) + map.size / 2;
  const auto at = static_cast<std::size_t>(row * map.size + column);
  EXPECT_EQ(map.mask[at], 1);
  EXPECT_NEAR(map.height[at], tower.z(), 1e-6);
  EXPECT_NEAR(map.height[at + 1], tower.z() - 7, 1e-6);
  EXPECT_EQ(std::max_element(map.detail.begin(), map.detail.end()) - map.detail.begin(),
            static_cast<std::ptrdiff_t>(at));
}

TEST(HeightMap, IsTheSameWhicheverWayTheScanIsTurned) {
  Rng rng = make_stream(1, "test");
  const Points points = plateau();
  const Eigen::Isometry3d T = random_pose(50, rng);
  const Points turned = transformed({points, {}}, T).points;
  const Footprint a = find_footprint(points, Eigen::Vector3d::UnitZ());
  const Footprint b = find_footprint(turned, T.linear() * Eigen::Vector3d::UnitZ());
  // Quantiles along axes that are turned: the middle moves a little with the heading.
  EXPECT_NEAR(a.radius_m, b.radius_m, 0.05 * a.radius_m);
  EXPECT_LT((a.T_map_scan.inverse().translation() - T.inverse() * b.T_map_scan.inverse().translation()).norm(),
            0.05 * a.radius_m);
  EXPECT_GT((a.T_map_scan.inverse().translation() - b.T_map_scan.inverse().translation()).norm(), 0.5 * a.radius_m);
}

// A strip across the map and a few cells apart from it: most rows and columns hold few cells, some none.
TEST(HeightMap, HasDetailInProportionToTheHeightAboveTheMeanOfWhatWasSeenNearby) {
  Rng rng = make_stream(4, "test");
  Points points;
  for (const auto& p : random_points(400, 60, rng)) points.emplace_back(p.x(), p.x() / 2 + p.y() / 20, p.z());
  for (const auto& p : random_points(8, 60, rng)) points.push_back(p);
  HeightMapOptions options;
  options.smoothing_cells = 4;
  options.clip_sigma = 1e6;  // nothing is cut off
  const HeightMap map = make_height_map({points, {}}, find_footprint(points, Eigen::Vector3d::UnitZ()), 1.0, options);
  constexpr int kReach = 12;  // three standard deviations
  double products = 0, squares = 0;
  std::vector<double> above(map.mask.size(), 0);
  for (int i = 0; i < map.size * map.size; ++i) {
    if (map.mask[static_cast<std::size_t>(i)] == 0) continue;
    double sum = 0, weights = 0;
    for (int j = 0; j < map.size * map.size; ++j) {
      const int rows = j / map.size - i / map.size, columns = j % map.size - i % map.size;
      if (map.mask[static_cast<std::size_t>(j)] == 0 || std::max(std::abs(rows), std::abs(columns)) > kReach) continue;
      const double weight = std::exp(-(rows * rows + columns * columns) / 32.0);
      sum += weight * map.height[static_cast<std::size_t>(j)];
      weights += weight;
    }
    const auto k = static_cast<std::size_t>(i);
    above[k] = map.height[k] - sum / weights;
    products += above[k] * map.detail[k];
    squares += above[k] * above[k];
  }
  ASSERT_GT(squares, 1);
  for (std::size_t k = 0; k < above.size(); ++k) EXPECT_NEAR(map.detail[k], products / squares * above[k], 1e-4);
}

TEST(HeightMap, HasDetailOfVarianceOneWhereSomethingWasSeen) {
  Rng rng = make_stream(2, "test");
  const Points points = random_points(20000, 30, rng);
  const HeightMap map = make_height_map({points, {}}, find_footprint(points, Eigen::Vector3d::UnitZ()), 0.5);
  double squares = 0;
  for (std::size_t k = 0; k < map.mask.size(); ++k) {
    squares += map.detail[k] * map.detail[k];
    if (map.mask[k] == 0) {
      EXPECT_EQ(map.detail[k], 0);
    }
  }
  EXPECT_NEAR(squares / map.num_seen, 1, 1e-3);
  EXPECT_EQ(std::accumulate(map.mask.begin(), map.mask.end(), 0.0), map.num_seen);
}

TEST(HeightMap, ForgetsASlope) {
  Rng rng = make_stream(3, "test");
  Points flat = random_points(30000, 40, rng);
  for (auto& p : flat) p.z() *= 0.1;
  Points sloping = flat;
  for (auto& p : sloping) p.z() += 0.1 * p.x();
  const Footprint footprint = find_footprint(flat, Eigen::Vector3d::UnitZ());
  HeightMapOptions options;
  options.smoothing_cells = 3;
  const HeightMap a = make_height_map({flat, {}}, footprint, 1, options);
  const HeightMap b = make_height_map({sloping, {}}, footprint, 1, options);
  double height_difference = 0, detail_difference = 0;
  int num_cells = 0;
  // At the rim the smooth mean lags behind the slope.
  for (int row = a.size / 2 - 9; row <= a.size / 2 + 9; ++row) {
    for (int column = a.size / 2 - 9; column <= a.size / 2 + 9; ++column) {
      const auto k = static_cast<std::size_t>(row * a.size + column);
      height_difference += std::abs(a.height[k] - b.height[k]);
      detail_difference += std::abs(a.detail[k] - b.detail[k]);
      ++num_cells;
    }
  }
  // The slope spans 1.8 m here, 0.45 m from its middle on average. Of the detail, in standard deviations, changes what
  // the slope does within a cell.
  EXPECT_GT(height_difference / num_cells, 0.4);
  EXPECT_LT(detail_difference / num_cells, 0.4);
}

TEST(HeightMap, OfOneHeightHasNoDetail) {
  Points points;
  for (int i = 0; i < 100; ++i) points.emplace_back(i % 10, i / 10, 3);
  const HeightMap map = make_height_map({points, {}}, find_footprint(points, Eigen::Vector3d::UnitZ()), 1);
  for (const float d : map.detail) EXPECT_EQ(d, 0);
}

TEST(HeightMap, RejectsOptionsOutOfBounds) {
  HeightMapOptions options;
  options.smoothing_cells = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.clip_sigma = -1;
  EXPECT_THROW(options.validate(), InvalidOptions);
  const Points points = plateau();
  EXPECT_THROW(make_height_map({points, {}}, find_footprint(points, Eigen::Vector3d::UnitZ()), 0), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp::testing
