#include "coarse/map_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/random_points.hpp"

namespace tcm_icp::testing {
namespace {

// Filled to its very border, so that the last rows and columns count, too.
HeightMap random_map(int size, Rng& rng) {
  HeightMap map;
  map.size = size;
  map.cell_m = 1;
  const auto n = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  map.height.assign(n, 0.0F);
  for (auto* image : {&map.mask, &map.detail, &map.structure}) image->assign(n, 0.0F);
  const Points values = random_points(n, 2, rng);
  for (std::size_t k = 0; k < n; ++k) {
    if (values[k].x() < -0.5) continue;
    map.mask[k] = 1;
    map.detail[k] = static_cast<float>(values[k].y());
    map.structure[k] = static_cast<float>(values[k].z());
    ++map.num_seen;
  }
  return map;
}

double correlation(const std::vector<std::array<double, 2>>& pairs) {
  double t = 0, s = 0, tt = 0, ss = 0, ts = 0;
  for (const auto& [a, b] : pairs) t += a, s += b, tt += a * a, ss += b * b, ts += a * b;
  const auto n = static_cast<double>(pairs.size());
  return (ts - t * s / n) / std::sqrt((tt - t * t / n) * (ss - s * s / n));
}

// Cell by cell, of those whose surroundings lie in the target, as agreement() has it.
double slow_agreement(const HeightMap& target, const MapCells& source, const MapPeak& pose, int dx, int dy) {
  std::vector<std::array<double, 2>> detail, structure;
  for (std::size_t i = 0; i < source.position.size(); ++i) {
    const double x = source.position[i].x(), y = source.position[i].y(), c = std::cos(pose.heading_rad),
                 s = std::sin(pose.heading_rad), half = target.size / 2 + 0.5;
    const double u = c * x - s * y + pose.x + half, v = s * x + c * y + pose.y + half;
    if (!(u >= 1 && v >= 1 && u < target.size - 1 && v < target.size - 1)) continue;
    const int row = static_cast<int>(v) + dy, column = static_cast<int>(u) + dx;
    const auto k = static_cast<std::size_t>(row * target.size + column);
    if (target.mask[k] == 0) continue;
    detail.push_back({target.detail[k], source.detail[i]});
    structure.push_back({target.structure[k], source.structure[i]});
  }
  return (correlation(detail) + correlation(structure)) * std::sqrt(static_cast<double>(detail.size()) / 2);
}

TEST(MapAgreement, IsThatOfALoopOverTheSharedCells) {
  Rng rng = make_stream(1, "map_agreement_test");
  const HeightMap target = random_map(20, rng), source = random_map(24, rng);
  const MapCells cells = list_cells(source, 1000);
  for (const double heading_rad : {0.0, 0.7, -2.0}) {
    MapPeak pose;
    pose.heading_rad = heading_rad;
    pose.x = 2;
    pose.y = -1;
    // Floats, summed over some 300 cells.
    EXPECT_NEAR(agreement(target, cells, pose, 1), slow_agreement(target, cells, pose, 0, 0), 1e-4);
  }
}

TEST(MapAgreement, FindsTheBestOfTheNineShiftsNearby) {
  Rng rng = make_stream(2, "map_agreement_test");
  const HeightMap target = random_map(20, rng), source = random_map(24, rng);
  const MapCells cells = list_cells(source, 1000);
  MapPeak start;
  start.heading_rad = 0.4;
  double best = 0;
  for (int k = 0; k < 9; ++k) best = std::max(best, slow_agreement(target, cells, start, k % 3 - 1, k / 3 - 1));
  ASSERT_GT(best, slow_agreement(target, cells, start, 0, 0) + 1e-3);
  const MapPeak found = refine_peak(target, cells, start, 0, 1);
  EXPECT_NEAR(found.score, best, 1e-4);
  EXPECT_NEAR(slow_agreement(target, cells, start, static_cast<int>(std::lround(found.x)),
                             static_cast<int>(std::lround(found.y))),
              best, 1e-4);
}

TEST(MapAgreement, IsNothingWhereMapsDoNotMeet) {
  Rng rng = make_stream(3, "map_agreement_test");
  const HeightMap map = random_map(20, rng);
  MapPeak far;
  far.x = 100;
  EXPECT_EQ(agreement(map, list_cells(map, 1000), far, 1), 0);
}

}  // namespace
}  // namespace tcm_icp::testing
