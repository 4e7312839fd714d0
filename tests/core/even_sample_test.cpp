#include "tcm_icp/core/even_sample.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

Points on_a_line(std::size_t count) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(static_cast<double>(i), 0, 0);
  return points;
}

TEST(EvenSample, TakesPointsAtEqualSteps) {
  // 7 points, 3 wanted: floor(0), floor(7 / 3) = 2, floor(14 / 3) = 4.
  const Points sample = even_sample(on_a_line(7), 3);
  ASSERT_EQ(sample.size(), 3u);
  EXPECT_EQ(sample[0].x(), 0);
  EXPECT_EQ(sample[1].x(), 2);
  EXPECT_EQ(sample[2].x(), 4);
}

TEST(EvenSample, IsTheWholeCloudWhereItIsSmallEnough) {
  EXPECT_EQ(even_sample(on_a_line(5), 5), on_a_line(5));
  EXPECT_EQ(even_sample(on_a_line(5), 100), on_a_line(5));
  EXPECT_TRUE(even_sample(Points{}, 3).empty());
  EXPECT_TRUE(even_sample(on_a_line(5), 0).empty());
}

TEST(EvenSample, NeverExceedsItsBound) {
  for (const std::size_t n : {9u, 10u, 11u, 19u, 20u, 21u})
    EXPECT_EQ(even_sample(on_a_line(n), 10).size(), std::min<std::size_t>(n, 10));
}

}  // namespace
}  // namespace tcm_icp
