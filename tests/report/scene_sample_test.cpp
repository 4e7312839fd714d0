#include "report/scene_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tcm_icp {
namespace {

// A line of `n` points 1 m apart in x, beginning at `from`.
std::vector<Eigen::Vector3d> line(std::size_t n, double from = 0) {
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < n; ++i) out.emplace_back(from + static_cast<double>(i), 0, 0);
  return out;
}

std::size_t num_of(const ScenePoints& points, std::size_t scan) { return points[scan].size(); }

TEST(SceneSampler, TakesAllWhereThereAreFewerThanWanted) {
  SceneSampler sampler({10, 20}, 1000);
  sampler.add(0, line(10), Eigen::Vector3d(1, 0, 0));
  sampler.add(1, line(20), Eigen::Vector3d::Zero());
  const ScenePoints points = sampler.take({1, 1}, 1);
  EXPECT_EQ(num_of(points, 0), 10U);
  EXPECT_EQ(num_of(points, 1), 20U);
  EXPECT_EQ(points[0][0], Eigen::Vector3f(-1, 0, 0)) << "minus the scan's origin";
}

TEST(SceneSampler, GivesScansTheSameShareAndWhatSmallOnesLeave) {
  SceneSampler sampler({100, 100000, 200000, 0}, 10100);
  sampler.add(0, line(100), Eigen::Vector3d::Zero());
  sampler.add(1, line(100000), Eigen::Vector3d::Zero());
  sampler.add(2, line(200000), Eigen::Vector3d::Zero());
  const ScenePoints points = sampler.take({1, 1, 1, 1}, 2);
  EXPECT_EQ(num_of(points, 0), 100U);
  // Points are drawn one by one: the numbers are binomial, with standard deviations of about 60.
  EXPECT_NEAR(static_cast<double>(num_of(points, 1)), 5000, 400);
  EXPECT_NEAR(static_cast<double>(num_of(points, 2)), 5000, 400);
  EXPECT_EQ(num_of(points, 3), 0U);
}

TEST(SceneSampler, DoesNotDependOnBlocksOrThreads) {
  const auto sampled = [](std::size_t block, int num_threads) {
    SceneSampler sampler({50000}, 1000);
    const auto points = line(50000);
    for (std::size_t i = 0; i < points.size(); i += block) {
      sampler.add(0, std::span(points).subspan(i, std::min(block, points.size() - i)), Eigen::Vector3d::Zero());
    }
    return sampler.take({100}, num_threads);
  };
  const ScenePoints one = sampled(50000, 1);
  EXPECT_GT(num_of(one, 0), 800U);
  EXPECT_EQ(one, sampled(777, 3));
}

TEST(EvenOverCells, DoesNotLetADensePlaceTakeAll) {
  std::vector<Eigen::Vector3f> points(9000, Eigen::Vector3f(0.5F, 0.5F, 0.5F));
  for (int i = 1; i <= 100; ++i) {
    for (int k = 0; k < 10; ++k) points.emplace_back(static_cast<float>(i) + 0.5F, 0.5F, 0.5F);
  }
  const auto even = even_over_cells(points, 505, 1);
  const auto dense = std::count_if(even.begin(), even.end(), [](const auto& p) { return p.x() < 1; });
  EXPECT_NEAR(static_cast<double>(even.size()), 505, 80);
  EXPECT_LT(dense, 30) << "of 101 cells one";
  EXPECT_TRUE(even_over_cells({}, 5, 1).empty());
}

}  // namespace
}  // namespace tcm_icp
