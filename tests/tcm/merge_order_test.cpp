#include "tcm_icp/tcm/merge_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Candidates = std::vector<MergeCandidate>;

TEST(MergeOrder, TakesTheSmallestTau) {
  const Candidates candidates{{0, {2, 3, 1}}, {1, {1, 4, 1}}, {2, {5, 1, 1}}};  // tau 6, 4, 5
  EXPECT_EQ(next_scan_to_merge(candidates), 1u);
}

TEST(MergeOrder, EqualTausGoToTheSmallerFH) {
  const Candidates candidates{{0, {2, 0, 1}}, {1, {8, 0, 0.125}}, {2, {4, 0, 0.5}}};  // tau 0; f h 2, 1, 2
  EXPECT_EQ(next_scan_to_merge(candidates), 1u);
}

TEST(MergeOrder, WhatIsEqualThroughoutGoesInFileOrderWhateverTheOrderOfTheCandidates) {
  Candidates candidates{{3, {2, 0, 1}}, {1, {2, 0, 1}}, {2, {2, 0, 1}}};
  EXPECT_EQ(next_scan_to_merge(candidates), 1u);
  std::reverse(candidates.begin(), candidates.end());
  EXPECT_EQ(next_scan_to_merge(candidates), 1u);
}

TEST(MergeOrder, RefusesNothingAndNaN) {
  EXPECT_THROW(next_scan_to_merge({}), InvalidInput);
  const Candidates candidates{{0, {1, 1, 1}}, {1, {std::numeric_limits<double>::quiet_NaN(), 1, 1}}};
  EXPECT_THROW(next_scan_to_merge(candidates), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
