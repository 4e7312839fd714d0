#include "tcm_icp/io/scan_colour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

TEST(ScanColour, IsPinned) {
  EXPECT_EQ(scan_colour(0), (std::array<std::uint8_t, 3>{242, 73, 73}));
  EXPECT_EQ(scan_colour(0), scan_colour(0));
}

TEST(ScanColour, FirstScansAreFarApartAndBright) {
  double least = 1000;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto a = scan_colour(i);
    EXPECT_GE(*std::max_element(a.begin(), a.end()), 180);
    for (std::size_t j = 0; j < i; ++j) {
      const auto b = scan_colour(j);
      least = std::min(least, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
  EXPECT_GT(least, 40);  // of 255: neighbours in the list of colours can be told apart on a screen
}

}  // namespace
}  // namespace tcm_icp
