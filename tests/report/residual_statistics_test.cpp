#include "report/residual_statistics.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace tcm_icp {
namespace {

TEST(ResidualStatistics, AreThoseOfTheAbsoluteValues) {
  std::vector<float> distances;
  for (int i = 1; i <= 100; ++i) distances.push_back(static_cast<float>(i % 2 == 0 ? i : -i) / 1000);
  const auto s = residual_statistics(distances, 0.0305, 0.2);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->num, 100U);
  EXPECT_NEAR(s->median_m, 0.050, 1e-6);
  EXPECT_NEAR(s->p95_m, 0.095, 1e-6);
  EXPECT_NEAR(s->rms_m, std::sqrt(101 * 201 / 6.0) / 1000, 1e-6) << "sum of squares of 1..n";
  EXPECT_NEAR(s->mean_m, 0.0005, 1e-6);
  EXPECT_NEAR(*s->share_accepted, 0.30, 1e-12);
}

TEST(ResidualStatistics, RmsLeavesOutWhatIsFarOffTheNoise) {
  std::vector<float> distances(99, 0.002F);
  distances.push_back(1.0F);
  const auto s = residual_statistics(distances, 0, 0.1);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->rms_m, 0.002, 1e-6);
  EXPECT_NEAR(s->rms_all_m, 0.1, 1e-4);
  const auto exact = residual_statistics({0.0F, 0.0F, 0.0F, 1.0F}, 0, 0.1);
  EXPECT_EQ(exact->rms_m, 0) << "scans without noise";
}

TEST(ResidualStatistics, HistogramHoldsEveryPointAndKeepsSigns) {
  const auto s = residual_statistics({-5.0F, -0.001F, 0.0F, 0.001F, 0.099F, 7.0F}, 0, 0.1);
  ASSERT_TRUE(s);
  EXPECT_FALSE(s->share_accepted);
  EXPECT_EQ(std::accumulate(s->counts.begin(), s->counts.end(), std::size_t{0}), 6U);
  EXPECT_EQ(s->counts.front(), 1U) << "what lies beyond";
  EXPECT_EQ(s->counts.back(), 2U);
  EXPECT_EQ(s->counts[s->counts.size() / 2], 3U);
  EXPECT_FALSE(residual_statistics({}, 0.01, 0.1)) << "of nothing there are none";
}

}  // namespace
}  // namespace tcm_icp
