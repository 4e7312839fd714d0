#include "pipeline/link_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tcm_icp {
namespace {

constexpr double kVoxel_m = 0.4;

struct Link {
  AlignmentEvidence evidence;
  PoseCandidate candidate;
  double score(double voxel_m = kVoxel_m) const { return link_log_odds(evidence, candidate, voxel_m); }
};

Link usual() {
  Link link;
  link.evidence.num_points = 500;
  link.evidence.overlap = 0.5;
  link.evidence.inlier_share = 0.5;
  link.evidence.median_residual_m = 0.1 * kVoxel_m;
  link.evidence.left_after_slide = {0.5, 0.45, 0.4, 0.35, 0.3, 0.25};
  link.candidate.method = CoarseMethod::kHeightMap;
  link.candidate.margin = 1.2;
  return link;
}

// Over its whole range a quantity moves the score one way: `change` with larger arguments never raises it.
template <typename Change>
void expect_falling(const Change& change, std::initializer_list<double> values) {
  for (const auto method : {CoarseMethod::kFeatures, CoarseMethod::kHeightMap}) {
    double last = std::numeric_limits<double>::infinity();
    for (const double value : values) {
      Link link = usual();
      link.candidate.method = method;
      change(link, value);
      EXPECT_LT(link.score(), last) << "at " << value;
      last = link.score();
    }
  }
}

TEST(LinkLogOdds, MoreOverlapMoreAgreementAndAClearerMarginRaiseIt) {
  expect_falling([](Link& l, double x) { l.evidence.overlap = 1 - x; }, {0, 0.2, 0.5, 0.8, 0.98});
  expect_falling([](Link& l, double x) { l.evidence.inlier_share = 1 - x; }, {0, 0.2, 0.5, 0.8, 0.98});
  expect_falling([](Link& l, double x) { l.candidate.margin = 3 - x; }, {0, 1, 1.9, 2.1, 2.6});
}

TEST(LinkLogOdds, ResidualsAndWhatSlidesLeaveLowerIt) {
  expect_falling([](Link& l, double x) { l.evidence.median_residual_m = x * kVoxel_m; }, {0.01, 0.05, 0.1, 0.3, 1});
  expect_falling([](Link& l, double x) { l.evidence.left_after_slide[0] = x; }, {0.5, 0.6, 0.75, 0.9, 1.5});
  for (std::size_t k = 1; k < 6; ++k) {
    expect_falling([k](Link& l, double x) { l.evidence.left_after_slide[k] = x; }, {0, 0.1, 0.25, 0.5, 1});
  }
}

// The weakest direction counts by itself and in the mean.
TEST(LinkLogOdds, TheWeakestDirectionCountsMost) {
  const auto raised = [](std::size_t k) {
    Link link = usual();
    link.evidence.left_after_slide[k] += 0.1;
    return link.score();
  };
  for (std::size_t k = 1; k < 6; ++k) EXPECT_LT(raised(0), raised(k) - 0.1);
}

TEST(LinkLogOdds, UnitsDoNotMatter) {
  for (const double factor : {0.001, 1000.0}) {
    Link link = usual();
    link.evidence.median_residual_m *= factor;
    link.evidence.tolerance_m *= factor;
    link.evidence.slide_m *= factor;
    link.candidate.T_target_source.translation() *= factor;
    EXPECT_NEAR(link.score(factor * kVoxel_m), usual().score(), 1e-9);
    EXPECT_GT(std::abs(link.score() - usual().score()), 1) << "it is the voxel that residuals are measured by";
  }
}

// The score of a method is not comparable over sets; only how far a candidate stands out is.
TEST(LinkLogOdds, TheCoarseScoreAndThePoseItselfSayNothing) {
  Link link = usual();
  link.candidate.score = 1000;
  link.candidate.T_target_source.translation().x() = 30;
  link.evidence.runner_up = 1;
  EXPECT_EQ(link.score(), usual().score());
}

TEST(LinkLogOdds, IsFiniteWhereThereIsNothing) {
  Link nothing;
  EXPECT_TRUE(std::isfinite(nothing.score()));
  nothing.evidence.left_after_slide.fill(1e9);  // all agreement came from elsewhere
  EXPECT_TRUE(std::isfinite(nothing.score()));
  EXPECT_LT(nothing.score(), -10);
  Link perfect = usual();
  perfect.evidence.median_residual_m = 0;
  perfect.evidence.left_after_slide.fill(0);
  EXPECT_TRUE(std::isfinite(perfect.score()));
  EXPECT_GT(perfect.score(), kClearLogOdds);
}

TEST(LinkLogOdds, TellsAGoodLinkFromAPoorOne) {
  Link poor = usual();
  poor.evidence.overlap = 0.3;
  poor.evidence.inlier_share = 0.2;
  poor.evidence.median_residual_m = 0.4 * kVoxel_m;
  poor.evidence.left_after_slide = {1, 0.9, 0.8, 0.7, 0.6, 0.5};
  poor.candidate.margin = 1;
  EXPECT_LT(poor.score(), -kClearLogOdds);
  Link good = usual();
  good.evidence.overlap = 0.7;
  good.evidence.inlier_share = 0.7;
  EXPECT_GT(good.score(), kClearLogOdds);
}

TEST(MisfitLogOdds, WhatFitsHalfAsWellAsOthersLosesNothing) {
  for (const double ratio : {0.1, 1.0, 2.0}) EXPECT_EQ(misfit_log_odds(ratio * 0.01, 0.01), 0) << ratio;
  EXPECT_NEAR(misfit_log_odds(0.048, 0.01), -4 * std::log(2.4), 1e-12);
  EXPECT_EQ(misfit_log_odds(0.048, 0.01), misfit_log_odds(48, 10)) << "whatever the unit";
  EXPECT_EQ(misfit_log_odds(0.01, 0), 0) << "perfect data";
}

TEST(FreeSpaceLogOdds, FallWithWhatRightPosesDoNotHave) {
  EXPECT_EQ(free_space_log_odds({}), 0) << "not looked at";
  EXPECT_EQ(free_space_log_odds({50, 20, 0, 0}), 0) << "too few points tell";
  EXPECT_EQ(free_space_log_odds({2000, 4, 2000, 20}), 0) << "as right poses have";
  double last = 0;
  for (const std::size_t violating : {20u, 25u, 30u, 40u}) {
    const double now = free_space_log_odds({2000, violating, 0, 0});
    EXPECT_LT(now, last) << violating;
    last = now;
  }
  EXPECT_LT(free_space_log_odds({2000, 4, 2000, 300}), -3) << "opposite sides of walls";
  EXPECT_GT(free_space_log_odds({500, 5, 0, 0}), free_space_log_odds({50000, 500, 0, 0}))
      << "of few, chance makes more";
}

}  // namespace
}  // namespace tcm_icp
