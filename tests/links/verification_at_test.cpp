#include "links/verification_at.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

TEST(VerificationAt, AllLengthsFollowTheResolution) {
  const VerificationOptions fine = verification_at(0.1), coarse = verification_at(100);
  EXPECT_NO_THROW(fine.validate());
  EXPECT_DOUBLE_EQ(coarse.gate_m, 1000 * fine.gate_m);
  EXPECT_DOUBLE_EQ(coarse.tolerance_m, 1000 * fine.tolerance_m);
  EXPECT_DOUBLE_EQ(coarse.slide_m, 1000 * fine.slide_m);
  EXPECT_LT(fine.tolerance_m, fine.gate_m);
  EXPECT_LT(fine.gate_m, fine.slide_m);
}

}  // namespace
}  // namespace tcm_icp
