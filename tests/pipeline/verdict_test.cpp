#include "pipeline/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace tcm_icp {
namespace {

AlignmentEvidence good() {
  AlignmentEvidence evidence;
  evidence.num_points = 1500;
  evidence.overlap = 0.6;
  evidence.inlier_share = 0.6;
  evidence.left_after_slide = {0.4, 0.3, 0.2, 0.1, 0.1, 0.1};
  evidence.runner_up = 0.3;
  return evidence;
}

// The reason's first word, or "accepted".
std::string outcome(AlignmentEvidence evidence) {
  const Verdict verdict = judge(evidence);
  EXPECT_FALSE(verdict.reason.empty());
  return verdict.accepted ? "accepted" : verdict.reason.substr(0, verdict.reason.find(' '));
}

TEST(Judge, AcceptsGoodEvidenceWithAndWithoutASearchForOtherPoses) {
  EXPECT_EQ(outcome(good()), "accepted");
  AlignmentEvidence not_looked_for = good();
  not_looked_for.runner_up = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outcome(not_looked_for), "accepted");
}

TEST(Judge, EachKindOfEvidenceCanRejectAlone) {
  AlignmentEvidence e = good();
  e.overlap = 0.05;
  EXPECT_EQ(outcome(e), "only") << "three in a hundred agree";
  e = good();
  e.num_points = 60;
  EXPECT_EQ(outcome(e), "only") << "22 points are too few to tell";
  e = good();
  e.inlier_share = 0.15;
  EXPECT_EQ(outcome(e), "only") << "neighbours at random agree as often";
  e = good();
  e.left_after_slide[0] = 0.9;
  EXPECT_EQ(outcome(e), "ambiguous:") << "it slides";
  e = good();
  e.runner_up = 0.95;
  EXPECT_EQ(outcome(e), "ambiguous:") << "another pose is as good";
  EXPECT_FALSE(judge({}).accepted) << "no evidence";
}

// A corridor: walls agree wherever the scan slides to.
TEST(Judge, WhatLiesAcrossHoldsAScanThatSlidesIfFreeSpaceBearsItOut) {
  const FreeSpaceEvidence clear{1000, 2, 1000, 2}, some{1000, 12, 1000, 2};
  AlignmentEvidence e = good();
  e.left_after_slide[0] = 0.9;
  e.left_across = 0.2;
  e.num_across = 100;
  EXPECT_TRUE(judge(e, clear).accepted);
  EXPECT_FALSE(judge(e).accepted) << "nothing bears it out";
  EXPECT_FALSE(judge(e, {50, 0, 1000, 2}).accepted) << "too little was looked at";
  EXPECT_TRUE(judge(good(), some).accepted);
  EXPECT_FALSE(judge(e, some).accepted) << "no veto, but more than right poses have";
  e.left_across = 0.8;
  EXPECT_FALSE(judge(e, clear).accepted) << "what lies across slides as well";
  e.left_across = 0.2;
  e.num_across = 10;
  EXPECT_FALSE(judge(e, clear).accepted) << "chance";
}

TEST(Judge, WhatIsSeenThroughIsRejectedWhateverElseAgrees) {
  EXPECT_TRUE(judge(good(), {1000, 10, 1000, 50}).accepted) << "noise, and what moved";
  const Verdict through = judge(good(), {1000, 100, 0, 0}), behind = judge(good(), {0, 0, 1000, 400});
  EXPECT_FALSE(through.accepted);
  EXPECT_NE(through.reason.find("seen through walls: 10 %"), std::string::npos) << through.reason;
  EXPECT_FALSE(behind.accepted);
  EXPECT_NE(behind.reason.find("40 % was seen from opposite sides"), std::string::npos) << behind.reason;
  AlignmentEvidence poor = good();
  poor.overlap = 0.05;
  EXPECT_FALSE(judge(poor, {1000, 0, 1000, 0}).accepted) << "nothing violated speaks for nothing";
}

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
