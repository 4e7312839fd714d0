#include "tcm_icp/core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tcm_icp {
namespace {

TEST(Random, TheEngineIsTheStandardOne) {
  Rng rng;  // the standard fixes the 10,000th number of a default mt19937_64
  rng.discard(9999);
  EXPECT_EQ(rng(), 9981545732273789042ULL);
}

TEST(Random, StreamsDependOnSeedStageAndItem) {
  std::set<std::uint64_t> first;
  for (const std::uint64_t seed : {1u, 2u}) {
    for (const char* stage : {"outliers", "annealing"}) {
      for (const char* item : {"", "000.ply", "001.ply"}) first.insert(make_stream(seed, stage, item)());
    }
  }
  EXPECT_EQ(first.size(), 12u);
  EXPECT_NE(make_stream(1, "ab", "c")(), make_stream(1, "a", "bc")());
  EXPECT_EQ(make_stream(1, "outliers", "000.ply")(), make_stream(1, "outliers", "000.ply")());
}

TEST(Random, Uniform01IsInItsRangeAndCentred) {
  Rng rng = make_stream(1, "random_test");
  double sum = 0, least = 1, largest = 0;
  for (int i = 0; i < 100000; ++i) {
    const double u = uniform01(rng);
    least = std::min(least, u);
    largest = std::max(largest, u);
    sum += u;
  }
  EXPECT_GE(least, 0);
  EXPECT_LT(largest, 1);
  EXPECT_NEAR(sum / 100000, 0.5, 0.005);  // five standard errors of 0.29 / 316
}

TEST(Random, UniformIndexReachesEveryIndexEquallyOften) {
  Rng rng = make_stream(2, "random_test");
  std::vector<int> count(7, 0);
  for (int i = 0; i < 70000; ++i) ++count.at(uniform_index(rng, 7));
  for (const int c : count) EXPECT_NEAR(c, 10000, 500);  // five standard deviations of 93
  EXPECT_EQ(uniform_index(rng, 1), 0u);
}

TEST(Random, StandardNormalHasItsMoments) {
  Rng rng = make_stream(3, "random_test");
  double sum = 0, squares = 0, fourth = 0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const double x = standard_normal(rng);
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.012);  // five standard errors each
  EXPECT_NEAR(squares / kCount, 1, 0.016);
  EXPECT_NEAR(fourth / kCount, 3, 0.11);
}

TEST(Random, SampleIndicesAreDifferentAscendingAndFair) {
  Rng rng = make_stream(4, "random_test");
  std::vector<int> count(10, 0);
  for (int i = 0; i < 20000; ++i) {
    const auto chosen = sample_indices(rng, 10, 3);
    ASSERT_EQ(chosen.size(), 3u);
    ASSERT_TRUE(chosen[0] < chosen[1] && chosen[1] < chosen[2]);
    for (const std::size_t c : chosen) ++count.at(c);
  }
  for (const int c : count) EXPECT_NEAR(c, 6000, 325);  // five standard deviations of 65
}

TEST(Random, SampleIndicesAreAllWhereTooManyAreWanted) {
  Rng rng = make_stream(5, "random_test");
  EXPECT_EQ(sample_indices(rng, 3, 9), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(sample_indices(rng, 3, 3), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(sample_indices(rng, 3, 0).empty());
  EXPECT_TRUE(sample_indices(rng, 0, 3).empty());
}

}  // namespace
}  // namespace tcm_icp
