#include "links/hypotheses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "links/measured_links.hpp"
#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::kNoise_m;
using testing::kVoxel_m;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

using testing::kInfinity;
constexpr double kSetSpread = 1;

// Four scans of one place, each in its own frame.
class HypothesisSetTest : public ::testing::Test {
 protected:
  HypothesisSetTest() {
    for (int i = 0; i < 4; ++i) T_.push_back(testing::random_pose(30, rng_));
    const Points points = testing::random_points(50, 10, rng_);
    set_.emplace(kVoxel_m, kNoise_m, std::vector<PointMoments>(4, PointMoments(points)));
  }

  /// The truth with scan b put aside; agrees at `consensus` of its points.
  LinkHypothesis aside(std::size_t a, std::size_t b, double off_m, double consensus = 0.5) const {
    LinkHypothesis h;
    h.T_a_b = T_[a].inverse() * T_[b] * Eigen::Translation3d(0, off_m, 0);
    h.measurements = testing::usual_link();
    h.measurements.evidence.inlier_share = 1;
    h.measurements.evidence.overlap = consensus;
    h.candidate.margin = 1.5;
    return h;
  }
  const std::vector<LinkHypothesis>& of(std::size_t a, std::size_t b) const { return set_->pairs().at({a, b}); }

  Rng rng_ = make_stream(1, "hypotheses_test");
  std::vector<Isometry3d> T_;
  std::optional<HypothesisSet> set_;
};

TEST_F(HypothesisSetTest, AKnownPoseIsNotAddedAgain) {
  const double same_m = set_->same_m();
  EXPECT_DOUBLE_EQ(same_m, 4 * kVoxel_m);
  set_->add(0, 1, {aside(0, 1, 0, 0.5)});
  EXPECT_DOUBLE_EQ(set_->fitted_m(), kVoxel_m);
  set_->add(0, 1, {aside(0, 1, 0.2 * same_m, 0.9), aside(0, 1, 2 * same_m), aside(0, 1, 2.2 * same_m)});
  ASSERT_EQ(of(0, 1).size(), 2u);
  EXPECT_EQ(of(0, 1)[0].measurements.evidence.overlap, 0.5) << "it is left as it is";
  set_->add(0, 1, {aside(0, 1, 0.5 * same_m)});
  EXPECT_EQ(of(0, 1).size(), 3u) << "one pose to inference, and perhaps a wall's other face";
  set_->add(0, 2, {aside(0, 2, 0)});
  EXPECT_EQ(of(0, 2).size(), 1u) << "of another pair";
}

// Whichever was found first: else the order of searches would decide what a pair is worth.
TEST_F(HypothesisSetTest, ASearchSaysMoreThanAFitFromWhereOthersLead) {
  LinkHypothesis implied = aside(0, 1, 0), found = aside(0, 1, 0.1 * set_->same_m());
  implied.candidate.method = CoarseMethod::kImplied;
  found.candidate.method = CoarseMethod::kFeatures;
  for (const auto& [first, second] : {std::pair(implied, found), std::pair(found, implied)}) {
    HypothesisSet set = *set_;
    set.add(0, 1, {first});
    set.add(0, 1, {second});
    ASSERT_EQ(set.pairs().at({0, 1}).size(), 1u);
    EXPECT_EQ(set.pairs().at({0, 1})[0].candidate.method, CoarseMethod::kFeatures);
  }
}

TEST_F(HypothesisSetTest, APairComparedInVainIsKnown) {
  set_->add(1, 3, {});
  ASSERT_EQ(set_->pairs().count({1, 3}), 1u);
  EXPECT_TRUE(of(1, 3).empty());
  set_->score();
  EXPECT_EQ(set_->log_odds(1, 3), -kInfinity);
  EXPECT_EQ(set_->log_odds(0, 1), -kInfinity) << "as one that was not compared";
}

TEST_F(HypothesisSetTest, ScoringPutsTheLikeliestFirst) {
  LinkHypothesis terrible = aside(0, 1, 5);
  terrible.measurements = testing::terrible_link();
  set_->add(0, 1, {terrible, aside(0, 1, 0, 0.7), aside(0, 1, -5, 0.2)});
  set_->score();
  ASSERT_EQ(of(0, 1).size(), 3u);
  EXPECT_TRUE(testing::is_pose_near(terrible.T_a_b, of(0, 1).back().T_a_b, 0, 0));
  for (std::size_t k = 1; k < 3; ++k) EXPECT_GE(of(0, 1)[k - 1].log_odds, of(0, 1)[k].log_odds);
  EXPECT_GT(of(0, 1).front().log_odds, of(0, 1).back().log_odds);
  EXPECT_EQ(set_->log_odds(0, 1), of(0, 1).front().log_odds);
  EXPECT_EQ(set_->log_odds(1, 0), set_->log_odds(0, 1)) << "in either order";
}

// Two poses that the pair alone does not tell apart: where the scanners stood does.
TEST_F(HypothesisSetTest, WhatIsKnownOfTheSurveyCountsBesideWhatThePairShows) {
  std::vector<SurveyedScan> surveyed(4);
  for (const std::size_t i : {0U, 1U}) {
    surveyed[i].points.push_back({std::to_string(i), Vector3d::Zero(), T_[i].translation(), 0.02, 0});
  }
  const Isometry3d wrong = T_[0].inverse() * T_[1] * Eigen::Translation3d(0, 5, 0);
  ASSERT_GT(std::abs(wrong.translation().norm() - (T_[0].translation() - T_[1].translation()).norm()), 2);
  HypothesisSet set(kVoxel_m, kNoise_m, set_->moments(), {surveyed, kVoxel_m});
  for (HypothesisSet* s : {&*set_, &set}) {
    s->add(0, 1, {aside(0, 1, 5), aside(0, 1, 0)});
    s->add(0, 2, {aside(0, 2, 5)});
    s->score();
  }
  EXPECT_EQ(of(0, 1)[0].log_odds, of(0, 1)[1].log_odds);
  const auto& known = set.pairs().at({0, 1});
  EXPECT_TRUE(testing::is_pose_near(T_[0].inverse() * T_[1], known[0].T_a_b, 1e-9, 1e-9));
  EXPECT_EQ(known[0].log_odds, of(0, 1)[0].log_odds);
  EXPECT_EQ(known[1].log_odds, known[0].log_odds - 8);
  EXPECT_EQ(known[1].by_survey, -8);
  EXPECT_EQ(set.log_odds(0, 2), set_->log_odds(0, 2)) << "of the third scan nothing is known";
  const auto there = set.compared_there(
      {{0, 1, wrong, testing::usual_link()}, {0, 1, T_[0].inverse() * T_[1], testing::usual_link()}});
  EXPECT_NEAR(there[0].hypotheses[0].log_odds, there[1].hypotheses[0].log_odds - 8, 1e-9);
}

TEST_F(HypothesisSetTest, TheSecondBestIsOfClearlyDifferentPosesOfThePair) {
  const double same_m = set_->same_m();
  set_->add(0, 1, {aside(0, 1, 0, 0.6), aside(0, 1, 0.8 * same_m, 0.5), aside(0, 1, 10 * same_m, 0.3)});
  set_->add(0, 2, {aside(0, 2, 0, 0.9)});
  set_->score();
  for (const LinkHypothesis& h : of(0, 1)) {
    const double own = h.measurements.evidence.consensus();
    EXPECT_NEAR(h.second_best_ratio, own == 0.3 ? 2 : 0.3 / own, 1e-12) << own;
  }
  EXPECT_EQ(of(0, 2)[0].second_best_ratio, 0) << "there is none";
}

// Along a corridor two scans agree most where both stand at one place, and see through one another's walls.
TEST_F(HypothesisSetTest, WhatFreeSpaceVetoesIsNobodysSecondBest) {
  LinkHypothesis vetoed = aside(0, 1, 9, 0.9);
  vetoed.measurements.free_space = {2000, 200, 0, 0};
  ASSERT_TRUE(vetoed.measurements.free_space.vetoes());
  set_->add(0, 1, {aside(0, 1, 0, 0.6), vetoed});
  set_->score();
  for (const LinkHypothesis& h : of(0, 1)) {
    const double own = h.measurements.evidence.consensus();
    EXPECT_NEAR(h.second_best_ratio, own == 0.6 ? 0 : 0.6 / 0.9, 1e-12) << own;
  }
}

TEST_F(HypothesisSetTest, WhatAgreesNowhereHasAnInfinitelyBetterSecond) {
  set_->add(0, 1, {aside(0, 1, 0, 0), aside(0, 1, 9, 0.4)});
  set_->add(0, 2, {aside(0, 2, 0, 0), aside(0, 2, 9, 0)});
  set_->score();
  for (const LinkHypothesis& h : of(0, 1)) {
    EXPECT_EQ(h.second_best_ratio, h.measurements.evidence.overlap > 0 ? 0 : kInfinity);
    EXPECT_TRUE(std::isfinite(h.log_odds));
  }
  for (const LinkHypothesis& h : of(0, 2)) EXPECT_EQ(h.second_best_ratio, 0);
}

// They are relative to what the set's better hypotheses show.
TEST_F(HypothesisSetTest, ScoringComparesWithTheWholeSet) {
  set_->add(0, 1, {aside(0, 1, 0)});
  set_->score();
  const double before = set_->reference().typical_residual_m;
  LinkHypothesis closer = aside(2, 3, 0, 0.9);
  closer.measurements.evidence.median_residual_m /= 5;
  set_->add(2, 3, {closer});
  set_->score();
  EXPECT_LT(set_->reference().typical_residual_m, before);
  EXPECT_EQ(set_->reference().voxel_m, kVoxel_m);
}

// They are mostly wrong, and would make what the first search found look better or worse than it is.
TEST_F(HypothesisSetTest, ScoringComparesWithNoLaterHypotheses) {
  set_->add(0, 1, {aside(0, 1, 0)});
  set_->score();
  const SetReference before = set_->reference();
  LinkHypothesis later = aside(2, 3, 0, 0.9);
  later.measurements.evidence.median_residual_m /= 5;
  later.stage = SearchStage::kLater;
  set_->add(2, 3, {later});
  set_->score();
  EXPECT_EQ(set_->reference().typical_residual_m, before.typical_residual_m);
  EXPECT_EQ(set_->reference().best_inlier_share, before.best_inlier_share);
}

// A loop tells which of its hypotheses are right, however poor all of them look.
TEST_F(HypothesisSetTest, WhatTheSetsPosesConfirmMakesItsOtherHypothesesLikelier) {
  for (const auto& [a, b] : Pairs{{0, 1}, {0, 2}, {1, 2}, {0, 3}}) {
    LinkHypothesis poor = aside(a, b, 0, 0.1);
    poor.measurements.evidence.left_after_slide = {1, 0.9, 0.8, 0.7, 0.6, 0.5};
    set_->add(a, b, {poor});
  }
  set_->score();
  const double before = set_->log_odds(0, 3), of_loop = set_->log_odds(0, 1);
  const PairGraph graph = set_->graph({true, true, true, true}, {});
  Component loop = component_of_one(0, 4);
  for (const std::size_t i : {1, 2}) loop.T_reference_scan[i] = T_[0].inverse() * T_[i];
  EXPECT_TRUE(set_->learn_constants({loop}, {weakest_cuts(graph, loop)}, kSetSpread));
  const double constant = set_->reference().constant;
  EXPECT_GT(constant, 0);
  set_->score();
  EXPECT_DOUBLE_EQ(set_->log_odds(0, 3), before + constant);
  EXPECT_DOUBLE_EQ(set_->log_odds(0, 1), of_loop + constant);
  EXPECT_FALSE(set_->learn_constants({loop}, {weakest_cuts(graph, loop)}, kSetSpread))
      << "learnt from what the hypotheses are by themselves";
}

TEST_F(HypothesisSetTest, WhatTheSetsPosesContradictMakesItsOtherHypothesesUnlikelier) {
  for (const auto& [a, b] : Pairs{{0, 1}, {0, 2}, {1, 2}}) set_->add(a, b, {aside(a, b, 30), aside(a, b, -40)});
  set_->score();
  Component elsewhere = component_of_one(0, 4);
  for (const std::size_t i : {1, 2}) elsewhere.T_reference_scan[i] = T_[0].inverse() * T_[i];
  const auto cuts = weakest_cuts(set_->graph({true, true, true, true}, {}), elsewhere);
  set_->learn_constants({elsewhere}, {cuts}, kSetSpread);
  EXPECT_LT(set_->reference().constant, 0);
}

// What is searched for scans that were left is wrong more often; that says nothing of what the first search found.
TEST_F(HypothesisSetTest, LaterHypothesesTeachAConstantOfTheirOwn) {
  for (const auto& [a, b] : Pairs{{0, 1}, {0, 2}, {1, 2}}) set_->add(a, b, {aside(a, b, 0, 0.1)});
  set_->score();
  Component loop = component_of_one(0, 4);
  for (const std::size_t i : {1, 2}) loop.T_reference_scan[i] = T_[0].inverse() * T_[i];
  const auto cuts = weakest_cuts(set_->graph({true, true, true, true}, {}), loop);
  const auto learn = [&] {
    set_->learn_constants({loop}, {cuts}, kSetSpread);
    return set_->reference();
  };
  const SetReference first = learn();
  EXPECT_EQ(first.later_constant, 0) << "there are none";
  LinkHypothesis later = aside(1, 2, 30);
  later.stage = SearchStage::kLater;
  set_->add(1, 2, {later});
  const SetReference both = learn();
  EXPECT_NEAR(both.constant, first.constant, 0.01);
  EXPECT_LT(both.later_constant, -0.1);
  const double before = set_->log_odds(0, 1);
  set_->score();
  EXPECT_EQ(set_->reference().later_constant, both.later_constant) << "scoring keeps it";
  const auto& of_pair = set_->pairs().at({1, 2});
  ASSERT_EQ(of_pair.size(), 2u);
  EXPECT_NE(of_pair[0].is_later(), of_pair[1].is_later());
  EXPECT_GT(std::abs(set_->log_odds(0, 1) - before), 0) << "the constant of the first is in effect";
}

// Dozens are looked at for the one that stands out.
TEST_F(HypothesisSetTest, OfDeepOnesOnlyWhatIsLikelierRightThanWrongIsLeft) {
  LinkHypothesis likely = aside(0, 1, 0), unlikely = aside(0, 1, 30, 0.05), searched = aside(0, 1, -40, 0.05);
  for (LinkHypothesis* h : {&unlikely, &searched}) {
    h->measurements.free_space.num_violating = h->measurements.free_space.num_points / 10;
  }
  likely.stage = unlikely.stage = SearchStage::kDeep;
  searched.stage = SearchStage::kLater;
  set_->add(0, 1, {likely, unlikely, searched});
  set_->score();
  ASSERT_GT(of(0, 1)[0].log_odds, 0);
  ASSERT_LT(of(0, 1)[1].log_odds, 0);
  set_->drop_unlikely_deep();
  ASSERT_EQ(of(0, 1).size(), 2u);
  EXPECT_EQ(of(0, 1)[0].stage, SearchStage::kDeep);
  EXPECT_EQ(of(0, 1)[1].stage, SearchStage::kLater) << "what the best of a search show stays, likely or not";
}

TEST_F(HypothesisSetTest, ADeepOneTakesThePlaceOfAnImpliedOneOnlyIfItIsLikely) {
  LinkHypothesis right = aside(0, 1, 0), wrong = aside(0, 1, 30, 0.05);
  wrong.measurements.free_space.num_violating = wrong.measurements.free_space.num_points / 10;
  for (const SearchStage stage : {SearchStage::kFirst, SearchStage::kDeep}) {
    for (LinkHypothesis* h : {&right, &wrong}) {
      h->stage = stage;
      h->candidate.method = stage == SearchStage::kDeep ? CoarseMethod::kHeightMap : CoarseMethod::kImplied;
    }
    set_->add(0, 1, {right, wrong});
    set_->score();
  }
  ASSERT_EQ(of(0, 1).size(), 4u);
  set_->add(0, 1, {right});
  ASSERT_EQ(of(0, 1).size(), 4u) << "beside an implied one, but once";
  set_->drop_unlikely_deep();
  ASSERT_EQ(of(0, 1).size(), 2u);
  EXPECT_EQ(of(0, 1)[0].candidate.method, CoarseMethod::kHeightMap);
  EXPECT_EQ(of(0, 1)[1].candidate.method, CoarseMethod::kImplied) << "what speaks against the pose is kept";
}

TEST_F(HypothesisSetTest, TheGraphHasThePairsOfOpenScans) {
  for (const auto& [a, b] : Pairs{{0, 1}, {0, 3}, {1, 2}}) set_->add(a, b, {aside(a, b, 0)});
  set_->score();
  const PairGraph graph = set_->graph({true, true, true, false}, {});
  ASSERT_EQ(graph.pairs().size(), 2u);
  EXPECT_EQ(graph.num_scans(), 4u) << "positions are those of the set";
  EXPECT_EQ(graph.pairs()[1].a, 1u);
  EXPECT_EQ(graph.pairs()[1].b, 2u);
  EXPECT_EQ(graph.pairs()[1].hypotheses[0].log_odds, set_->log_odds(1, 2));
  const Isometry3d& T = graph.pairs()[1].hypotheses[0].T_a_b;
  EXPECT_TRUE(graph.same_pose(2, T, T * Eigen::Translation3d(0.9 * set_->same_m(), 0, 0)));
  EXPECT_FALSE(graph.same_pose(2, T, T * Eigen::Translation3d(1.1 * set_->same_m(), 0, 0)));
}

TEST_F(HypothesisSetTest, WhatAPairShowsWhereOthersPutItIsJudgedLikeAHypothesis) {
  LinkHypothesis implied = aside(0, 1, 0);
  implied.candidate.method = CoarseMethod::kImplied;
  set_->add(0, 1, {implied, aside(0, 1, 3 * set_->same_m(), 0.7)});
  set_->add(1, 2, {aside(1, 2, 0)});
  set_->score();
  const auto& known = of(0, 1);
  const auto fit = std::find_if(known.begin(), known.end(),
                                [](const auto& h) { return h.candidate.method == CoarseMethod::kImplied; });
  ASSERT_NE(fit, known.end());
  const auto there = set_->compared_there(
      {{0, 1, implied.T_a_b, implied.measurements}, {0, 3, implied.T_a_b, testing::terrible_link()}});
  ASSERT_EQ(there.size(), 2u);
  const PoseHypothesis& h = there[0].hypotheses.at(0);
  EXPECT_TRUE(h.implied && h.is_there);
  EXPECT_DOUBLE_EQ(h.log_odds, fit->log_odds) << "with the same rival";
  EXPECT_EQ(h.overlap, 0.5);
  EXPECT_EQ(there[1].b, 3u) << "a pair that was not compared";
  EXPECT_LT(there[1].hypotheses.at(0).log_odds, h.log_odds);
}

// Of pairs of the first three scans, as the true poses have them.
class WithoutUnlikely : public HypothesisSetTest {
 protected:
  void compare(std::size_t a, std::size_t b, double off_m) { set_->add(a, b, {aside(a, b, off_m)}); }
  Pairs kept(const std::vector<MeasuredPose>& there = {}) {
    set_->score();
    return set_->without_unlikely(all_, T_, set_->compared_there(there));
  }
  const Pairs all_{{0, 1}, {1, 2}, {0, 2}};
};

TEST_F(WithoutUnlikely, APairWhoseHypothesesLeadElsewhereIsLeftOut) {
  compare(0, 1, 0.1);
  compare(1, 2, -0.1);
  compare(0, 2, 3);
  EXPECT_EQ(kept(), (Pairs{{0, 1}, {1, 2}}));
}

TEST_F(WithoutUnlikely, APairComparedInVainIsLeftOut) {
  compare(0, 1, 0);
  compare(1, 2, 0);
  set_->add(0, 2, {});
  EXPECT_EQ(kept(), (Pairs{{0, 1}, {1, 2}}));
}

TEST_F(WithoutUnlikely, APairThatLeadsThereButIsLikelierWrongIsLeftOut) {
  compare(0, 1, 0);
  compare(1, 2, 0);
  LinkHypothesis unlikely = aside(0, 2, 0);
  unlikely.measurements = testing::terrible_link();
  set_->add(0, 2, {unlikely});
  EXPECT_EQ(kept(), (Pairs{{0, 1}, {1, 2}}));
  ASSERT_LT(of(0, 2).front().log_odds, 0);
  ASSERT_GT(of(0, 1).front().log_odds, 0);
}

TEST_F(WithoutUnlikely, APairThatIsLikelyWhereTheOthersPutItStays) {
  compare(0, 1, 0);
  compare(1, 2, 0);
  compare(0, 2, 3);
  const LinkHypothesis there = aside(0, 2, 0.1), elsewhere = aside(0, 2, 3);
  EXPECT_EQ(kept({{0, 2, there.T_a_b, there.measurements}}), all_);
  EXPECT_EQ(kept({{0, 2, there.T_a_b, testing::terrible_link()}}), (Pairs{{0, 1}, {1, 2}})) << "it shows nothing";
  EXPECT_EQ(kept({{0, 2, elsewhere.T_a_b, elsewhere.measurements}}), (Pairs{{0, 1}, {1, 2}})) << "of other poses";
}

TEST_F(WithoutUnlikely, NotWhereItAloneConnectsItsScans) {
  compare(0, 1, 0);
  compare(1, 2, 3);
  compare(0, 2, 3);
  EXPECT_EQ(kept(), all_);
}

TEST_F(WithoutUnlikely, PairsThatWereNotComparedStay) {
  compare(0, 1, 0);
  compare(1, 2, 0);
  EXPECT_EQ(kept(), all_);
}

TEST_F(WithoutUnlikely, TheRightOneOfSeveralHypothesesIsEnough) {
  compare(0, 1, 0);
  compare(1, 2, 0);
  set_->add(0, 2, {aside(0, 2, 3), aside(0, 2, 0.1)});
  EXPECT_EQ(kept(), all_);
}

}  // namespace
}  // namespace tcm_icp
