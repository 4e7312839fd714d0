#include "decision/link_decision.hpp"

#include <gtest/gtest.h>

#include "links/measured_links.hpp"

namespace tcm_icp {
namespace {

using testing::kNoise_m;
using testing::kVoxel_m;

LinkRecord decided(const LinkMeasurements& m) {
  return judge_link(2, 5, m, SetReference::of(kVoxel_m, kNoise_m, {testing::usual_link(), testing::terrible_link()}));
}

TEST(JudgeLink, AUsualLinkIsLikelyAndATerribleOneRejected) {
  const LinkRecord usual = decided(testing::usual_link()), terrible = decided(testing::terrible_link());
  EXPECT_GT(usual.probability, 0.5);
  EXPECT_NE(usual.verdict, Verdict::kRejected);
  EXPECT_LT(terrible.probability, 0.5);
  EXPECT_EQ(terrible.verdict, Verdict::kRejected);
}

TEST(JudgeLink, TheRecordIsOfThePairAndItsMeasurements) {
  const LinkRecord record = decided(testing::usual_link());
  EXPECT_EQ(record.a, 2u);
  EXPECT_EQ(record.b, 5u);
  EXPECT_EQ(record.evidence.inlier_share, testing::usual_link().evidence.inlier_share);
  EXPECT_EQ(record.free_space.num_points, testing::usual_link().free_space.num_points);
  EXPECT_FALSE(record.strength);
}

TEST(JudgeLink, TheVerdictFollowsFromTheProbability) {
  LinkMeasurements m = testing::usual_link();
  for (const double left : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0}) {
    m.evidence.left_after_slide.fill(left);
    const LinkRecord d = decided(m);
    ASSERT_GE(d.probability, 0);
    ASSERT_LE(d.probability, 1);
    EXPECT_EQ(d.verdict, d.probability >= 0.95 ? Verdict::kAccepted
                         : d.probability < 0.5 ? Verdict::kRejected
                                               : Verdict::kDoubtful)
        << left;
  }
}

TEST(JudgeLink, TellsItsFiguresAndThoseOfFreeSpaceWhereEnoughWasSeen) {
  LinkMeasurements m = testing::usual_link();
  m.evidence.overlap = 0.37;
  m.free_space = {1000, 120, 0, 0};
  EXPECT_NE(decided(m).reason.find("37 %"), std::string::npos) << decided(m).reason;
  EXPECT_NE(decided(m).reason.find("12 % is seen through walls"), std::string::npos) << decided(m).reason;
  m.free_space = {50, 6, 0, 0};
  EXPECT_EQ(decided(m).reason.find("walls"), std::string::npos) << decided(m).reason;
}

}  // namespace
}  // namespace tcm_icp
