#include "links/pair_fits.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "links/empty_hypotheses.hpp"
#include "pipeline/prepared_scene.hpp"

namespace tcm_icp {
namespace {

using testing::no_hypotheses;
using testing::PreparedScene;

PreparedScene two_scans() {
  Rng rng = make_stream(8, "pair_fits_test");
  return testing::prepared_scene({.num_scans = 2, .points_per_scan = 15000, .noise_m = 0.01}, rng);
}

PoseCandidate about(const PreparedScene& s, double metres, double score) {
  PoseCandidate out;
  out.T_target_source = s.scene.T_target_source(0, 1);
  out.T_target_source.pretranslate(Eigen::Vector3d(metres, 0, 0));
  out.score = score;
  return out;
}

class PairFitsOfTwoScans : public ::testing::Test {
 protected:
  const PreparedScene s = two_scans();
  const LinkSearchOptions options;
  const RunContext context;
  PairFits fits{s.scans, options, context, nullptr};
  HypothesisSet set = no_hypotheses(s);
};

TEST_F(PairFitsOfTwoScans, FitFromTheMostPromisingCandidateAndEndWhereItIsClear) {
  EXPECT_TRUE(fits.poses_of(0, 1).empty());
  const double voxel_m = s.resolutions.coarse_m;
  ASSERT_GT(testing::pose_rmse_m(s.scene.T_target_source(0, 1), about(s, voxel_m, 2).T_target_source,
                                 s.scene.scans[1].points),
            0.25 * voxel_m)
      << "the start is no solution";
  fits.fit({{0, 1}}, {{about(s, voxel_m, 2), about(s, 30 * voxel_m, 1)}}, SearchStage::kLater, set);
  ASSERT_EQ(fits.poses_of(0, 1).size(), 1U) << "a clear hypothesis ends the fits of a pair";
  EXPECT_LE(testing::pose_rmse_m(s.scene.T_target_source(0, 1), fits.poses_of(0, 1)[0], s.scene.scans[1].points),
            0.25 * voxel_m);
  ASSERT_EQ(set.pairs().at({0, 1}).size(), 1U);
  EXPECT_TRUE(set.pairs().at({0, 1}).front().is_later());
}

TEST_F(PairFitsOfTwoScans, KnowWhichCandidatesWereLookedAt) {
  const double voxel_m = s.resolutions.coarse_m;
  const auto first = about(s, voxel_m, 2), other = about(s, 30 * voxel_m, 1);
  EXPECT_EQ(fits.untried(0, 1, {first, other}, voxel_m).size(), 2U) << "none was, yet";
  fits.fit({{0, 1}}, {{first}}, SearchStage::kLater, set);
  const auto left = fits.untried(0, 1, {about(s, 1.5 * voxel_m, 2), about(s, 2.5 * voxel_m, 2), other}, voxel_m);
  ASSERT_EQ(left.size(), 2U) << "the first lies within a voxel of the one that was";
  EXPECT_EQ(left[0].T_target_source.translation(), about(s, 2.5 * voxel_m, 2).T_target_source.translation());
  EXPECT_EQ(left[1].T_target_source.translation(), other.T_target_source.translation());
}

TEST_F(PairFitsOfTwoScans, KeepOfDeepCandidatesOnlyWhatIsLikelierRightThanWrong) {
  const double voxel_m = s.resolutions.coarse_m;
  PoseCandidate wrong = about(s, 0, 2);
  wrong.T_target_source.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  fits.fit({{0, 1}}, {{wrong}}, SearchStage::kDeep, set);
  ASSERT_EQ(fits.poses_of(0, 1).size(), 1U) << "it was fitted";
  EXPECT_TRUE(set.pairs().at({0, 1}).empty());
  fits.fit({{0, 1}}, {{about(s, voxel_m, 1)}}, SearchStage::kDeep, set);
  ASSERT_EQ(set.pairs().at({0, 1}).size(), 1U);
  EXPECT_GT(set.pairs().at({0, 1}).front().log_odds, 0);
}

TEST_F(PairFitsOfTwoScans, KnowAPairWithoutCandidatesAsCompared) {
  fits.fit({{0, 1}}, {{}}, SearchStage::kFirst, set);
  EXPECT_TRUE(fits.poses_of(0, 1).empty());
  ASSERT_TRUE(set.pairs().contains({0, 1}));
  EXPECT_TRUE(set.pairs().at({0, 1}).empty());
}

}  // namespace
}  // namespace tcm_icp
