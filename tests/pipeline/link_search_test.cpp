#include "pipeline/link_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/link_score.hpp"
#include "pipeline/prepared_scene.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;

// What coarse methods leave to the fit (their own tests ask for this much).
constexpr double kCoarseAngle = 0.06, kCoarseShift_m = 0.7;

PreparedScene scene(const testing::SyntheticSceneOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "link_search_test scenes");
  return testing::prepared_scene(options, rng);
}

const testing::SyntheticSceneOptions kYard{.points_per_scan = 6000, .range_m = 16, .noise_m = 0.02};

PoseCandidate candidate(const Isometry3d& T, double score, double margin) {
  PoseCandidate c;
  c.T_target_source = T;
  c.method = CoarseMethod::kHeightMap;
  c.score = score;
  c.margin = margin;
  return c;
}

PoseCandidate near_truth(const PreparedScene& s, double score, double margin, Rng& rng) {
  const Isometry3d truth = s.scene.T_target_source(0, 1);
  return candidate(testing::perturbed(truth, s.scene.scans[1].points, kCoarseAngle, kCoarseShift_m, rng), score,
                   margin);
}

double error_m(const PreparedScene& s, const Isometry3d& T) {
  return testing::pose_rmse_m(s.scene.T_target_source(0, 1), T, s.scene.scans[1].points);
}

TEST(FitCandidates, FindsTheRightOneAmongWrongOnes) {
  const PreparedScene s = scene(kYard, 1);
  const double tolerance = 0.25 * s.resolutions.coarse_m;  // a light fit: S refines it
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng = make_stream(seed, "link_search_test");
    std::vector<PoseCandidate> candidates;
    for (int k = 0; k < 6; ++k) candidates.push_back(candidate(testing::random_pose(5, rng), 60 - k, k == 0 ? 1.1 : 1));
    candidates.push_back(near_truth(s, 30, 1, rng));
    ASSERT_GT(error_m(s, candidates.back().T_target_source), 3 * tolerance);
    const CandidateLink link = fit_candidates(s.scans, 0, 1, candidates, {});
    ASSERT_FALSE(link.hypotheses.empty());
    const LinkHypothesis& best = link.hypotheses.front();
    EXPECT_LE(error_m(s, best.T_a_b), tolerance) << "seed " << seed;
    EXPECT_EQ(best.candidate.score, 30) << "it says what it started from";
    EXPECT_EQ(best.log_odds, link_log_odds(best.evidence, best.candidate, s.resolutions.coarse_m));
    EXPECT_GT(best.evidence.consensus(), 0.2);
    for (std::size_t k = 1; k < link.hypotheses.size(); ++k) {
      EXPECT_GT(error_m(s, link.hypotheses[k].T_a_b), 1) << "nor is it there twice";
      EXPECT_LT(link.hypotheses[k].log_odds, best.log_odds);
    }
  }
}

TEST(FitCandidates, AWrongCandidateAloneIsUnlikely) {
  // The yard nearly meets itself turned by half a turn; rubble does not.
  const PreparedScene s =
      scene({.shape = testing::SyntheticShape::kRubble, .points_per_scan = 6000, .noise_m = 0.02}, 1);
  Rng rng = make_stream(4, "link_search_test");
  for (int k = 0; k < 5; ++k) {
    const CandidateLink link = fit_candidates(s.scans, 0, 1, {candidate(testing::random_pose(5, rng), 10, 1)}, {});
    for (const auto& h : link.hypotheses) {
      if (error_m(s, h.T_a_b) > 1) {
        EXPECT_LT(h.log_odds, 0) << k;
      }
    }
  }
}

// Ground and ceiling hold nothing along them: each place fits as well as the next, and the graph has to decide.
TEST(FitCandidates, KeepsThePosesThatAPairCannotTellApart) {
  const PreparedScene s = scene(
      {.shape = testing::SyntheticShape::kParallelPlanes, .points_per_scan = 4000, .range_m = 10, .noise_m = 0.02}, 2);
  const Isometry3d truth = s.scene.T_target_source(0, 1), T_world_source = s.scene.T_world_scan[1];
  const Isometry3d along = T_world_source.inverse() * Eigen::Translation3d(4, 0, 0) * T_world_source;
  const CandidateLink link =
      fit_candidates(s.scans, 0, 1, {candidate(truth, 20, 0), candidate(truth * along, 19, 0)}, {});
  ASSERT_EQ(link.hypotheses.size(), 2u);
  EXPECT_GE(link.hypotheses[0].log_odds, link.hypotheses[1].log_odds);
  EXPECT_LT(link.hypotheses[0].log_odds, kClearLogOdds);
  EXPECT_NEAR(std::abs(error_m(s, link.hypotheses[0].T_a_b) - error_m(s, link.hypotheses[1].T_a_b)), 4, 1);
}

TEST(FitCandidates, CandidatesThatFitToOnePoseAreOneHypothesis) {
  const PreparedScene s = scene(kYard, 3);
  Rng rng = make_stream(5, "link_search_test");
  std::vector<PoseCandidate> candidates;
  // Without a margin none is clear, so that all three are fitted.
  for (int k = 0; k < 3; ++k) candidates.push_back(near_truth(s, 20 - k, 0, rng));
  const CandidateLink link = fit_candidates(s.scans, 0, 1, candidates, {});
  ASSERT_EQ(link.hypotheses.size(), 1u);
  EXPECT_LT(link.hypotheses[0].log_odds, kClearLogOdds);
  EXPECT_LE(error_m(s, link.hypotheses[0].T_a_b), 0.25 * s.resolutions.coarse_m);
}

TEST(FitCandidates, EachMethodsBestIsLookedAtWhateverLiesNearer) {
  const PreparedScene s = scene(kYard, 3);
  Rng rng = make_stream(6, "link_search_test");
  PoseCandidate by_features = candidate(testing::random_pose(5, rng), 2, 1.2);
  by_features.method = CoarseMethod::kFeatures;
  const PoseCandidate best_map = candidate(testing::random_pose(5, rng), 20, 0);
  std::vector<PoseCandidate> candidates;
  for (int k = 0; k < 4; ++k) candidates.push_back(near_truth(s, 10 - k, 0, rng));
  candidates.push_back(best_map);
  candidates.push_back(by_features);
  const CandidateLink link = fit_candidates(s.scans, 0, 1, candidates, {});
  bool map_seen = false, features_seen = false, near_seen = false;
  for (const auto& h : link.hypotheses) {
    map_seen |= h.candidate.method == CoarseMethod::kHeightMap && h.candidate.score == 20;
    features_seen |= h.candidate.method == CoarseMethod::kFeatures;
    near_seen |= h.candidate.score <= 10 && h.candidate.score >= 7;
  }
  EXPECT_TRUE(map_seen);
  EXPECT_TRUE(features_seen);
  EXPECT_TRUE(near_seen);
}

TEST(FitCandidates, WithoutCandidatesThereIsNoHypothesis) {
  const PreparedScene s = scene({.points_per_scan = 1000}, 4);
  const CandidateLink link = fit_candidates(s.scans, 0, 1, {}, {});
  EXPECT_EQ(link.a, 0u);
  EXPECT_EQ(link.b, 1u);
  EXPECT_TRUE(link.hypotheses.empty());
}

// Three poses apart from one another; free space vetoes the one that agrees best.
TEST(CandidateLink, AVetoedPoseIsUnlikelyAndNoRival) {
  const double voxel_m = 0.1;
  Rng rng = make_stream(8, "link_search_test");
  Points points;
  for (int i = 0; i < 100; ++i) points.push_back(testing::random_pose(10, rng).translation());
  CandidateLink link{0, 1, {}};
  for (const double agreeing : {0.6, 0.9, 0.5}) {
    LinkHypothesis h;
    h.T_a_b = testing::random_pose(30, rng);
    h.candidate.margin = 2;
    h.evidence.overlap = 0.8;
    h.evidence.inlier_share = agreeing;
    h.evidence.median_residual_m = 0.01;
    h.evidence.left_after_slide.fill(0.3);
    link.hypotheses.push_back(h);
  }
  const Isometry3d vetoed = link.hypotheses[1].T_a_b, right = link.hypotheses[0].T_a_b;
  link.hypotheses[1].free_space = {1000, 200, 0, 0};
  link.rank(points, voxel_m);
  EXPECT_TRUE(testing::is_pose_near(vetoed, link.hypotheses.back().T_a_b, 0, 0));
  EXPECT_LE(link.hypotheses.back().log_odds, kVetoedLogOdds);
  const LinkHypothesis& best = link.hypotheses.front();
  EXPECT_TRUE(testing::is_pose_near(right, best.T_a_b, 0, 0));
  EXPECT_EQ(best.log_odds, link_log_odds(best.evidence, best.candidate, voxel_m)) << "nothing lost to a vetoed pose";
  EXPECT_LT(link.hypotheses[1].log_odds,
            link_log_odds(link.hypotheses[1].evidence, link.hypotheses[1].candidate, voxel_m))
      << "but to the best";
}

TEST(CandidateLink, SwapSaysTheSameTheOtherWay) {
  Rng rng = make_stream(7, "link_search_test");
  CandidateLink link{4, 2, {}};
  for (const double log_odds : {1.0, 3.0}) {
    LinkHypothesis h;
    h.T_a_b = testing::random_pose(30, rng);
    h.candidate.T_target_source = testing::random_pose(30, rng);
    h.log_odds = log_odds;
    link.hypotheses.push_back(h);
  }
  const CandidateLink before = link;
  link.swap();
  EXPECT_EQ(link.a, 2u);
  EXPECT_EQ(link.b, 4u);
  for (std::size_t k = 0; k < 2; ++k) {
    const LinkHypothesis &x = before.hypotheses[k], &y = link.hypotheses[k];
    EXPECT_EQ(x.log_odds, y.log_odds);
    EXPECT_TRUE(testing::is_pose_near(x.candidate.T_target_source.inverse(), y.candidate.T_target_source, 1e-9, 1e-9));
    for (const std::size_t scan : {2u, 4u}) {
      EXPECT_TRUE(testing::is_pose_near(before.T_other(scan, x), link.T_other(scan, y), 1e-9, 1e-9)) << scan;
    }
    EXPECT_TRUE(testing::is_pose_near(x.T_a_b, before.T_other(2, x), 0, 0)) << "the pose of b in a";
    EXPECT_FALSE(testing::is_pose_near(x.T_a_b, before.T_other(4, x), 0.1, 1));
  }
  link.swap();
  EXPECT_EQ(link.a, 4u);
  EXPECT_TRUE(testing::is_pose_near(before.hypotheses[0].T_a_b, link.hypotheses[0].T_a_b, 1e-9, 1e-9));
}

}  // namespace
}  // namespace tcm_icp
