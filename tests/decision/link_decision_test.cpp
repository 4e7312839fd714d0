#include "decision/link_decision.hpp"

#include <gtest/gtest.h>

#include "links/measured_links.hpp"

namespace tcm_icp {
namespace {

using testing::kNoise_m;
using testing::kVoxel_m;

LinkDecision decided(const LinkMeasurements& m) {
  return decide_link(m, SetReference::of(kVoxel_m, kNoise_m, {testing::usual_link(), testing::terrible_link()}));
}

TEST(DecideLink, AUsualLinkIsLikelyAndATerribleOneRejected) {
  const LinkDecision usual = decided(testing::usual_link()), terrible = decided(testing::terrible_link());
  EXPECT_GT(usual.probability, 0.5);
  EXPECT_NE(usual.verdict, "rejected");
  EXPECT_LT(terrible.probability, 0.5);
  EXPECT_EQ(terrible.verdict, "rejected");
}

TEST(DecideLink, TheVerdictFollowsFromTheProbability) {
  LinkMeasurements m = testing::usual_link();
  for (const double left : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0}) {
    m.evidence.left_after_slide.fill(left);
    const LinkDecision d = decided(m);
    ASSERT_GE(d.probability, 0);
    ASSERT_LE(d.probability, 1);
    EXPECT_EQ(d.verdict, d.probability >= 0.95 ? "accepted" : d.probability < 0.5 ? "rejected" : "doubtful") << left;
  }
}

TEST(DecideLink, TellsItsFiguresAndThoseOfFreeSpaceWhereEnoughWasSeen) {
  LinkMeasurements m = testing::usual_link();
  m.evidence.overlap = 0.37;
  m.free_space = {1000, 120, 0, 0};
  EXPECT_NE(decided(m).text.find("37 %"), std::string::npos) << decided(m).text;
  EXPECT_NE(decided(m).text.find("12 % is seen through walls"), std::string::npos) << decided(m).text;
  m.free_space = {50, 6, 0, 0};
  EXPECT_EQ(decided(m).text.find("walls"), std::string::npos) << decided(m).text;
}

}  // namespace
}  // namespace tcm_icp
