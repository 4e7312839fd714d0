#include "coarse/common_bits.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

// Lengths about those that are summed at a time; full rows, where sums of bytes are largest.
TEST(CommonBits, AreCountedAsOneAfterTheOtherIs) {
  Rng rng = make_stream(1, "common_bits_test");
  for (const std::size_t length : {0U, 1U, 30U, 31U, 32U, 62U, 63U, 200U}) {
    for (const bool full : {false, true}) {
      std::vector<std::uint64_t> a, b;
      std::uint64_t expected = 0;
      for (std::size_t w = 0; w < length; ++w) {
        a.push_back(full ? ~std::uint64_t{0} : rng());
        b.push_back(full ? ~std::uint64_t{0} : rng());
        for (std::uint64_t left = a.back() & b.back(); left != 0; left >>= 1U) expected += left & 1U;
      }
      EXPECT_EQ(num_common_bits(a, b), expected) << length;
      EXPECT_EQ(num_common_bits_by_words(a, b), expected) << length;
    }
  }
}

}  // namespace
}  // namespace tcm_icp
