#include "links/link_likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "links/measured_links.hpp"

namespace tcm_icp {
namespace {

using testing::kNoise_m;
using testing::kVoxel_m;

const SearchMeasurements kClear{CoarseMethod::kHeightMap, 2, 0.4}, kTie{CoarseMethod::kHeightMap, 1, 1.2};

LinkFeatures features(const LinkMeasurements& m, const std::optional<SearchMeasurements>& search) {
  return link_features(m, search,
                       SetReference::of(kVoxel_m, kNoise_m, {testing::usual_link(), testing::terrible_link()}));
}

TEST(LinkLikelihood, TellsAnObviouslyRightPoseFromAnObviouslyWrongOne) {
  EXPECT_GT(hypothesis_log_odds(features(testing::usual_link(), kClear)), 0);
  EXPECT_LT(hypothesis_log_odds(features(testing::terrible_link(), kTie)), 0);
  EXPECT_GT(pose_log_odds(features(testing::usual_link(), std::nullopt)), 0);
  EXPECT_LT(pose_log_odds(features(testing::terrible_link(), std::nullopt)), 0);
}

TEST(LinkLikelihood, OfAPoseThatOtherScansLedToTheSearchSaysNothing) {
  const double without = pose_log_odds(features(testing::usual_link(), std::nullopt));
  EXPECT_EQ(pose_log_odds(features(testing::usual_link(), kClear)), without);
  EXPECT_EQ(pose_log_odds(features(testing::usual_link(), kTie)), without);
  EXPECT_NE(hypothesis_log_odds(features(testing::usual_link(), kClear)),
            hypothesis_log_odds(features(testing::usual_link(), kTie)));
}

TEST(LinkLikelihood, IsFiniteWhereNothingWasMeasured) {
  const LinkFeatures nothing = link_features({}, std::nullopt, {});
  EXPECT_TRUE(std::isfinite(hypothesis_log_odds(nothing)));
  EXPECT_TRUE(std::isfinite(pose_log_odds(nothing)));
}

}  // namespace
}  // namespace tcm_icp
