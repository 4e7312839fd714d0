#include "tcm_icp/tcm/hausdorff.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

double by_loops(const Points& a, const Points& b) {
  double largest = 0;
  for (const auto& p : a) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& q : b) least = std::min(least, (p - q).squaredNorm());
    largest = std::max(largest, least);
  }
  return largest;
}

TEST(Hausdorff, HasTheValueWorkedOutByHand) {
  const Points a{{0, 0, 0}, {1, 0, 0}}, b{{0, 2, 0}, {1, 2, 0}, {4, 2, 0}};
  EXPECT_DOUBLE_EQ(directed_hausdorff(a, b), 4);      // both points of a are 2 below one of b
  EXPECT_DOUBLE_EQ(directed_hausdorff(b, a), 9 + 4);  // (4,2,0) to (1,0,0)
  EXPECT_DOUBLE_EQ(hausdorff(a, b), 13);
  EXPECT_DOUBLE_EQ(hausdorff(b, a), 13);
}

TEST(Hausdorff, IsZeroToItself) {
  const Points a{{0, 0, 0}, {1, 5, 2}};
  EXPECT_EQ(hausdorff(a, a), 0);
}

TEST(Hausdorff, AgreesWithLoopsForAnyNumberOfThreads) {
  Rng rng = make_stream(1, "hausdorff_test");
  const Points a = testing::random_points(500, 3, rng), b = testing::random_points(400, 4, rng);
  for (const int threads : {1, 2, 8}) {
    EXPECT_EQ(directed_hausdorff(a, b, threads), directed_hausdorff(a, b, 1));
    EXPECT_NEAR(directed_hausdorff(a, b, threads), by_loops(a, b), 1e-14);
    EXPECT_NEAR(directed_hausdorff(b, a, threads), by_loops(b, a), 1e-14);
  }
}

TEST(Hausdorff, RefusesEmptyCloudsAndNaN) {
  const Points one{{0, 0, 0}}, nan{{std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  EXPECT_THROW(directed_hausdorff({}, one), InvalidInput);
  EXPECT_THROW(directed_hausdorff(one, {}), InvalidInput);
  EXPECT_THROW(directed_hausdorff(nan, one), InvalidInput);
  EXPECT_THROW(directed_hausdorff(one, nan), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
