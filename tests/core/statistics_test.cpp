#include "tcm_icp/core/statistics.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

TEST(MedianNonzero, LeavesOutWhatIsZeroButForRounding) {
  EXPECT_EQ(median_nonzero({0, 0, 0, 0, 3, 1, 2}), 2);
  EXPECT_EQ(median_nonzero({1e-16, 0, 3e-17, 0, 3, 1, 2}), 2);
  EXPECT_EQ(median_nonzero({1e-16, 1e-16, 3e-17, 1e-16, 3, 1, 2}), 2) << "as many, none of them zero";
}

TEST(MedianNonzero, HasNoUnit) {
  EXPECT_EQ(median_nonzero({1e-216, 0, 3e-200, 1e-200, 2e-200}), 2e-200);
  EXPECT_EQ(median_nonzero({1e184, 0, 3e200, 1e200, 2e200}), 2e200);
}

TEST(MedianNonzero, IsZeroWhereAllAreAndWhereThereAreNone) {
  EXPECT_EQ(median_nonzero({0, 0, 0}), 0);
  EXPECT_EQ(median_nonzero({}), 0);
}

}  // namespace
}  // namespace tcm_icp
