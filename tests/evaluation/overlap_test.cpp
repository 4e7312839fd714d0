#include "tcm_icp/evaluation/overlap.hpp"

#include <gtest/gtest.h>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

/// `count` points a metre apart along x, from `first`.
Points row(int first, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.emplace_back(first + i, 0, 0);
  return points;
}

TEST(OverlapMatrix, CountsThePointsWithinThreeSpacingsOfTheOther) {
  // 0..9 against 8.5..: points 6..9 lie within 3 m of 8.5 or beyond; of 0.5 m steps (1.5 m reach) points 7..9 do.
  Points denser;
  for (int i = 0; i < 20; ++i) denser.emplace_back(8.5 + 0.5 * i, 0, 0);
  const Eigen::MatrixXd overlap = overlap_matrix({row(0, 10), denser}, 1);
  EXPECT_DOUBLE_EQ(overlap(0, 0), 1);
  EXPECT_DOUBLE_EQ(overlap(0, 1), 0.3);
  EXPECT_DOUBLE_EQ(overlap(1, 0), 8 / 20.0);  // 8.5, 9.0, ..., 12.0
}

TEST(OverlapMatrix, IsZeroForCloudsApartAndForEmptyOnes) {
  const Eigen::MatrixXd overlap = overlap_matrix({row(0, 10), row(1000, 10), {}}, 1);
  EXPECT_EQ(overlap(0, 1), 0);
  EXPECT_EQ(overlap(0, 2), 0);
  EXPECT_EQ(overlap(2, 0), 0);
}

TEST(OverlapMatrix, DoesNotDependOnTheNumberOfThreads) {
  Rng rng = make_stream(3, "test");
  std::vector<Points> clouds(4);
  for (std::size_t k = 0; k < clouds.size(); ++k) {
    for (int i = 0; i < 500; ++i) {
      const double x = uniform01(rng), y = uniform01(rng), z = uniform01(rng);
      clouds[k].emplace_back(x + 0.3 * static_cast<double>(k), y, z);
    }
  }
  EXPECT_EQ(overlap_matrix(clouds, 1), overlap_matrix(clouds, 8));
}

}  // namespace
}  // namespace tcm_icp
