#include "links/link_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "links/measure_link.hpp"
#include "pipeline/prepared_scene.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;

// What coarse methods leave to the fit (their own tests ask for this much).
constexpr double kCoarseAngle = 0.06, kCoarseShift_m = 0.7;

PoseCandidate candidate(const Isometry3d& T, double score, CoarseMethod method = CoarseMethod::kHeightMap) {
  PoseCandidate c;
  c.T_target_source = T;
  c.method = method;
  c.score = score;
  c.margin = 1.3;
  return c;
}

class LinkFitTest : public ::testing::Test {
 protected:
  PoseCandidate near_truth(double score) {
    return candidate(testing::perturbed(s_.scene.T_target_source(0, 1), s_.scene.scans[1].points, kCoarseAngle,
                                        kCoarseShift_m, rng_),
                     score);
  }
  std::optional<LinkHypothesis> fit(const PoseCandidate& c) const {
    return fit_candidate(s_.scans[0], s_.scans[1], c, options_);
  }
  double error_m(const Isometry3d& T) const {
    return testing::pose_rmse_m(s_.scene.T_target_source(0, 1), T, s_.scene.scans[1].points);
  }

  Rng rng_ = make_stream(1, "link_fit_test");
  const PreparedScene s_ = testing::prepared_scene({.points_per_scan = 6000, .range_m = 16, .noise_m = 0.02}, rng_);
  const LinkSearchOptions options_;
};

TEST_F(LinkFitTest, AFitLeadsFromNearTheTruthToIt) {
  const double tolerance = 0.25 * s_.resolutions.coarse_m;  // a light fit: merging refines it
  for (int k = 0; k < 3; ++k) {
    const PoseCandidate start = near_truth(30);
    ASSERT_GT(error_m(start.T_target_source), 3 * tolerance);
    const auto h = fit(start);
    ASSERT_TRUE(h);
    EXPECT_LE(error_m(h->T_a_b), tolerance) << k;
    EXPECT_EQ(h->candidate.score, 30) << "it says what it started from";
    EXPECT_TRUE(testing::is_pose_near(start.T_target_source, h->candidate.T_target_source, 0, 0));
    EXPECT_EQ(h->log_odds, 0) << "only a set can tell";
  }
}

TEST_F(LinkFitTest, WhatIsMeasuredIsMeasuredAtTheFittedPose) {
  const auto h = fit(near_truth(30));
  ASSERT_TRUE(h);
  const LinkMeasurements at_fit = measure_link(s_.scans[0], s_.scans[1], h->T_a_b),
                         before = measure_link(s_.scans[0], s_.scans[1], h->candidate.T_target_source);
  EXPECT_EQ(h->measurements.evidence.consensus(), at_fit.evidence.consensus());
  EXPECT_EQ(h->measurements.evidence.median_residual_m, at_fit.evidence.median_residual_m);
  EXPECT_GT(at_fit.evidence.consensus(), 2 * before.evidence.consensus());
}

// From metres away matches of the widest distance lead elsewhere as often as to the truth.
TEST_F(LinkFitTest, AFitThatEndsFarOffIsTriedAgainNearItsCandidateAndTheBetterOneKept) {
  int num_better = 0;
  for (int k = 0; k < 12; ++k) {
    PoseCandidate start =
        candidate(testing::perturbed(s_.scene.T_target_source(0, 1), s_.scene.scans[1].points, 0.3, 2, rng_), 30);
    const auto wide = fit(start);
    start.accuracy_m = 0.02;
    const auto either = fit(start);
    ASSERT_TRUE(either || !wide);
    if (!either) continue;
    const double before = wide ? wide->measurements.evidence.consensus() : 0,
                 after = either->measurements.evidence.consensus();
    EXPECT_GE(after, before) << k;
    if (wide) {
      EXPECT_LE(either->measurements.free_space.violation_share(), wide->measurements.free_space.violation_share());
    }
    if (after > before) ++num_better;
  }
  EXPECT_GT(num_better, 0);
}

TEST_F(LinkFitTest, AFitThatEndsWhereItsCandidateMayBeIsKept) {
  PoseCandidate start = near_truth(30);
  const auto wide = fit(start);
  ASSERT_TRUE(wide);
  start.accuracy_m = 1.1 * testing::pose_rmse_m(start.T_target_source, wide->T_a_b, s_.scene.scans[1].points);
  const auto again = fit(start);
  ASSERT_TRUE(again);
  EXPECT_TRUE(testing::is_pose_near(wide->T_a_b, again->T_a_b, 0, 0));
}

TEST_F(LinkFitTest, WithoutOverlapThereIsNoFit) {
  EXPECT_FALSE(fit(candidate(Isometry3d(Eigen::Translation3d(500, 0, 0)), 30)));
}

TEST_F(LinkFitTest, PromiseIsHowNearThePointsLie) {
  std::vector<PoseCandidate> candidates{candidate(testing::random_pose(5, rng_), 60)};  // the best, by its score
  for (int k = 0; k < 4; ++k) candidates.push_back(candidate(testing::random_pose(5, rng_), 50 - k));
  candidates.push_back(near_truth(10));
  const auto order = in_order_of_promise(s_.scans[0], s_.scans[1], candidates);
  ASSERT_EQ(order.size(), candidates.size());
  EXPECT_EQ(order[0].score, 60);
  EXPECT_EQ(order[1].score, 10);
}

TEST_F(LinkFitTest, EachMethodsBestComesFirstWhateverLiesNearer) {
  std::vector<PoseCandidate> candidates;
  for (int k = 0; k < 4; ++k) candidates.push_back(near_truth(10 - k));
  candidates.push_back(candidate(testing::random_pose(5, rng_), 20));
  candidates.push_back(candidate(testing::random_pose(5, rng_), 2, CoarseMethod::kFeatures));
  const auto order = in_order_of_promise(s_.scans[0], s_.scans[1], candidates);
  ASSERT_EQ(order.size(), candidates.size());
  EXPECT_EQ(std::max(order[0].score, order[1].score), 20);
  EXPECT_EQ(std::min(order[0].score, order[1].score), 2);
  EXPECT_NE(order[0].method, order[1].method);
}

// Points lie nearest where two scans of a corridor overlap most: that is not where they stood.
TEST_F(LinkFitTest, SlidesAreInTheOrderOfTheirVotes) {
  std::vector<PoseCandidate> slides;
  for (int k = 0; k < 4; ++k) slides.push_back(candidate(testing::random_pose(5, rng_), 5 + k, CoarseMethod::kSlide));
  slides.push_back(near_truth(4));
  slides.back().method = CoarseMethod::kSlide;
  const auto order = in_order_of_promise(s_.scans[0], s_.scans[1], slides);
  ASSERT_EQ(order.size(), slides.size());
  for (std::size_t k = 1; k < order.size(); ++k) EXPECT_LT(order[k].score, order[k - 1].score);
}

TEST_F(LinkFitTest, WithoutCandidatesNothingIsPromised) {
  EXPECT_TRUE(in_order_of_promise(s_.scans[0], s_.scans[1], {}).empty());
}

}  // namespace
}  // namespace tcm_icp
