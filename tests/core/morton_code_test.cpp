#include "tcm_icp/core/morton_code.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

TEST(MortonCode, BitsGoToThreeTimesTheirPlaceAndBack) {
  for (const std::uint64_t bits : {0x0ULL, 0x1ULL, 0x155555ULL, 0x0badfULL, 0x1fffffULL}) {
    std::uint64_t one_by_one = 0;
    for (int k = 0; k < kMortonBits; ++k) one_by_one |= (bits >> k & 1) << 3 * k;
    EXPECT_EQ(morton_spread(bits), one_by_one) << bits;
    EXPECT_EQ(morton_gathered(one_by_one | one_by_one << 1 | kMortonAxis << 2), bits) << "whatever the other axes have";
  }
}

TEST(MortonCode, HigherBitsAreLeftOut) {
  EXPECT_EQ(morton_spread(1ULL << kMortonBits), 0U);
  EXPECT_EQ(morton_spread((1ULL << kMortonBits) - 1), kMortonAxis);
}

}  // namespace
}  // namespace tcm_icp
