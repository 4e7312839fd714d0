#include "pipeline/adjusted_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/prepared_scene.hpp"
#include "pipeline/synthetic_links.hpp"
#include "pipeline/verdict.hpp"

namespace tcm_icp {
namespace {

using testing::PreparedScene;

class AdjustedSetTest : public ::testing::Test {
 protected:
  void see_yard(std::size_t num_scans) { see(testing::SyntheticShape::kYard, num_scans); }
  void see(testing::SyntheticShape shape, std::size_t num_scans, double range_m = 18) {
    s_ = testing::prepared_scene(
        {.shape = shape, .num_scans = num_scans, .points_per_scan = 5000, .range_m = range_m, .noise_m = 0.02}, rng_);
    graph_ = PoseGraph(num_scans);
    set_.placed.assign(num_scans, true);
    set_.evidence.assign(num_scans, AlignmentEvidence{});
    set_.evidence[0].reset();
    set_.reasons.assign(num_scans, "");
    set_.group_log_odds.assign(num_scans, 0);
    for (std::size_t i = 0; i < num_scans; ++i) set_.T_reference_scan.push_back(s_.scene.T_target_source(0, i));
  }
  void displace(std::size_t i, double angle_rad, double shift_m) {
    set_.T_reference_scan[i] =
        testing::perturbed(set_.T_reference_scan[i], s_.scene.scans[i].points, angle_rad, shift_m, rng_);
  }
  /// As merging by links leaves it: the graph is asked for the scan's evidence.
  void link(std::size_t a, std::size_t b, double log_odds, double shift_m = 0.2) {
    graph_.add({a, b, {testing::link_hypothesis(s_.scene, a, b, log_odds, 0.01, shift_m, rng_)}});
    for (const std::size_t i : {a, b}) {
      if (set_.evidence[i]) set_.evidence[i]->link_log_odds = log_odds;
    }
  }
  void adjust() { adjust_and_verify(s_.scans, graph_, s_.resolutions, options_, context_, set_); }
  double error_m(std::size_t i) const {
    return testing::pose_rmse_m(s_.scene.T_target_source(0, i), set_.T_reference_scan[i], s_.scene.scans[i].points);
  }

  Rng rng_ = make_stream(1, "adjusted_set_test");
  PreparedScene s_;
  PoseGraph graph_{0};
  PipelineOptions options_;
  RunContext context_;
  AdjustedSet set_;
};

TEST_F(AdjustedSetTest, AllThatFitStayAndFitBetter) {
  see_yard(4);
  for (const std::size_t i : {1u, 2u, 3u}) displace(i, 0.01, 0.1);
  const double tolerance = 0.1 * s_.resolutions.fine_m;
  set_.evidence[2]->runner_up = 0.4;
  set_.evidence[2]->searched = true;
  adjust();
  EXPECT_EQ(set_.num_placed(), 4u);
  for (const std::size_t i : {1u, 2u, 3u}) {
    EXPECT_LE(error_m(i), tolerance) << i;
    EXPECT_GT(set_.evidence[i]->num_points, 0u);
    EXPECT_FALSE(set_.reasons[i].empty());
  }
  EXPECT_EQ(set_.evidence[2]->runner_up, 0.4) << "what its merge found out stays true";
  EXPECT_TRUE(set_.evidence[2]->searched);
  EXPECT_FALSE(set_.evidence[0]) << "the reference needs none";
  EXPECT_EQ(set_.adjustment.lp_status, LpStatus::kOptimal);
}

TEST_F(AdjustedSetTest, ADisplacedMemberIsTakenOut) {
  for (const std::size_t wrong : {1u, 2u, 3u}) {
    set_ = {};
    // In a yard ground alone agrees with ground at a third of the points; rubble has nothing that fits elsewhere.
    see(testing::SyntheticShape::kRubble, 4);
    displace(wrong, 1.2, 6);  // farther than the adjustment could bring back
    adjust();
    EXPECT_FALSE(set_.placed[wrong]) << error_m(wrong);
    EXPECT_EQ(set_.num_placed(), 3u) << "the others are none the worse without " << wrong;
    for (std::size_t i = 1; i < 4; ++i) {
      if (i != wrong) {
        EXPECT_LE(error_m(i), 0.1 * s_.resolutions.fine_m) << i << " without " << wrong;
      }
    }
    EXPECT_FALSE(judge(*set_.evidence[wrong]).accepted);
    EXPECT_EQ(set_.reasons[wrong], judge(*set_.evidence[wrong]).reason);
    for (const auto& [a, b] : set_.pairs) EXPECT_TRUE(a != wrong && b != wrong);
  }
}

TEST_F(AdjustedSetTest, LinksSpeakForTheFinalPoses) {
  see_yard(3);
  for (const std::size_t i : {1u, 2u}) displace(i, 0.01, 0.1);
  link(0, 1, 5);
  link(1, 2, 4);
  link(0, 2, 6);
  adjust();
  EXPECT_EQ(set_.num_placed(), 3u);
  EXPECT_EQ(set_.evidence[1]->link_log_odds, 9);
  EXPECT_EQ(set_.evidence[2]->link_log_odds, 10);
  EXPECT_EQ(set_.evidence[2]->num_links, 2u);
}

// Each of them fits; but links that are as likely lead elsewhere, so the scan may be in the wrong bay.
TEST_F(AdjustedSetTest, AMemberThatItsLinksContradictIsTakenOut) {
  see_yard(4);
  link(0, 1, 9);
  link(0, 2, 9);
  link(1, 2, 9);
  link(2, 3, 6);
  link(0, 3, 5, 8.0);
  adjust();
  EXPECT_EQ(set_.placed, (std::vector<bool>{true, true, true, false}));
  EXPECT_LT(set_.evidence[3]->link_log_odds, kMinLinkLogOdds);
  EXPECT_EQ(set_.evidence[1]->num_links, 2u);
}

// The one that links speak least for goes first. 2 and 3 contradict each other; without 3 nothing is left against 2.
TEST_F(AdjustedSetTest, TheWorstGoesFirstAndTheOthersAreJudgedAgain) {
  see_yard(4);
  link(0, 1, 9);
  link(0, 2, 5);
  link(0, 3, 4);
  link(2, 3, 8, 8.0);
  adjust();
  EXPECT_EQ(set_.placed, (std::vector<bool>{true, true, true, false}));
  EXPECT_EQ(set_.evidence[2]->link_log_odds, 5);
}

// A guessed scan came without links: what the graph has of it is not held against it.
TEST_F(AdjustedSetTest, LinksAreNotAskedAboutGuessedScans) {
  see_yard(3);
  link(0, 1, 8, 8.0);
  set_.evidence[1] = AlignmentEvidence{};
  adjust();
  EXPECT_EQ(set_.num_placed(), 3u);
  EXPECT_TRUE(std::isnan(set_.evidence[1]->link_log_odds));
}

// What it joined a group by counts beside its own links.
TEST_F(AdjustedSetTest, TheLinkOfAGroupSpeaksForTheScanThatJoinedByIt) {
  see_yard(3);
  link(0, 1, 9);
  link(0, 2, 1);
  set_.group_log_odds[2] = 4;
  adjust();
  EXPECT_EQ(set_.num_placed(), 3u);
  EXPECT_EQ(set_.evidence[2]->link_log_odds, 5);
}

// With the reference at the end of a row, all errors of the row pile up at its other end.
TEST_F(AdjustedSetTest, TheScanWithTheMostLinksBecomesTheReference) {
  see(testing::SyntheticShape::kYard, 8, 7);
  for (const std::size_t i : {1u, 3u, 5u, 6u, 7u}) set_.placed[i] = false;
  const AdjustedSet before = set_;
  options_.reference = "0.ply";
  adjust();
  EXPECT_EQ(set_.pairs, (ScanPairs{{0, 2}, {2, 4}})) << "a row, not a ring";
  EXPECT_EQ(set_.reference, 0u) << "the user's choice";
  set_ = before;
  options_.reference.clear();
  adjust();
  EXPECT_EQ(set_.reference, 2u);
  EXPECT_EQ(set_.num_placed(), 3u);
  EXPECT_TRUE(set_.T_reference_scan[2].isApprox(Eigen::Isometry3d::Identity(), 0));
  EXPECT_FALSE(set_.evidence[2]);
  EXPECT_GT(set_.evidence[0]->num_points, 0u) << "the one before is judged like the others";
  for (const std::size_t i : {0u, 4u}) {
    EXPECT_LE(testing::pose_rmse_m(s_.scene.T_target_source(2, i), set_.T_reference_scan[i], s_.scene.scans[i].points),
              0.2 * s_.resolutions.fine_m);
  }
}

TEST_F(AdjustedSetTest, ScansThatAreNoMembersAreLeftAlone) {
  see_yard(3);
  set_.placed[2] = false;
  set_.evidence[2].reset();
  displace(2, 0.4, 3);
  const Eigen::Isometry3d before = set_.T_reference_scan[2];
  adjust();
  EXPECT_EQ(set_.placed, (std::vector<bool>{true, true, false}));
  EXPECT_TRUE(set_.T_reference_scan[2].isApprox(before, 0));
  EXPECT_FALSE(set_.evidence[2]);
}

}  // namespace
}  // namespace tcm_icp
