#include "pipeline/leaving_scans.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace tcm_icp {
namespace {

using Scans = std::vector<std::size_t>;

// A chain of seven scans, each linked to the next; all pass until a test says otherwise.
class LeavingScans : public ::testing::Test {
 protected:
  static constexpr std::size_t kNumScans = 7;

  LeavingScans() : members_(kNumScans), decisions_(kNumScans) {
    std::iota(members_.begin(), members_.end(), std::size_t{0});
    for (Decision& d : decisions_) d = {Reason::kAccepted, 0.99, {}, {}};
    for (std::size_t i = 0; i + 1 < kNumScans; ++i) pairs_.emplace_back(i, i + 1);
  }
  void fail(std::size_t scan, double probability, Reason reason = Reason::kMisfit) {
    decisions_[scan].reason = reason;
    decisions_[scan].probability = probability;
  }
  void cut(const Scans& moved, double support) { cuts_.push_back({moved, support, 0, std::nullopt, 0}); }
  Scans leaving() const { return leaving_scans(members_, decisions_, cuts_, pairs_); }

  Scans members_;
  std::vector<Decision> decisions_;
  std::vector<Cut> cuts_;
  ScanPairs pairs_;
};

TEST_F(LeavingScans, NobodyWhereAllPass) {
  cut({3}, -5);
  EXPECT_EQ(leaving(), Scans{}) << "whatever a cut says: the decision has weighed it";
}

TEST_F(LeavingScans, OneThatDoesNotPass) {
  fail(3, 0.4);
  EXPECT_EQ(leaving(), Scans{3});
}

TEST_F(LeavingScans, OfNeighborsTheWorst) {
  fail(3, 0.4);
  fail(4, 0.3);
  EXPECT_EQ(leaving(), Scans{4});
}

TEST_F(LeavingScans, ThoseWithoutACommonLinkTogetherTheWorstFirst) {
  fail(1, 0.4);
  fail(5, 0.3);
  EXPECT_EQ(leaving(), (Scans{5, 1}));
}

TEST_F(LeavingScans, NeighborsOfOneThatWaitsWaitToo) {
  fail(2, 0.3);
  fail(3, 0.4);
  fail(4, 0.5);
  EXPECT_EQ(leaving(), Scans{2}) << "4 is judged again without 3, should that leave";
}

TEST_F(LeavingScans, AnAmbiguousOneWithWhatWouldMoveWithIt) {
  fail(5, 0.4, Reason::kAmbiguous);
  cut({4, 5, 6}, 2);
  cut({5}, 9);
  EXPECT_EQ(leaving(), (Scans{4, 5, 6}));
}

TEST_F(LeavingScans, TheSmallerOfTwoPartsThatMayLieElsewhereToOneAnother) {
  fail(5, 0.4, Reason::kAmbiguous);
  cut({2, 3, 4, 5, 6}, 2);
  EXPECT_EQ(leaving(), (Scans{0, 1}));
}

TEST_F(LeavingScans, WhatPairsSpeakAgainstGoesAlone) {
  fail(1, 0.1);
  fail(5, 0.4);
  cut({5, 6}, -0.5);
  cut({5}, 3);
  EXPECT_EQ(leaving(), (Scans{5, 6}));
}

TEST_F(LeavingScans, OfTwoContradictedCutsTheWorse) {
  fail(1, 0.1);
  fail(5, 0.4);
  cut({1}, -0.5);
  cut({5, 6}, -2);
  EXPECT_EQ(leaving(), (Scans{5, 6}));
}

}  // namespace
}  // namespace tcm_icp
