#include "pipeline/settled_component.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/prepared_scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Scans = std::vector<std::size_t>;

// Scans of one place with the hypotheses of all their pairs; tests say where inference has put them.
class SettledComponentTest : public ::testing::Test {
 protected:
  void see(testing::SyntheticShape shape, std::size_t num_scans, double range_m = 18) {
    s_ = testing::prepared_scene(
        {.shape = shape, .num_scans = num_scans, .points_per_scan = 5000, .range_m = range_m, .noise_m = 0.02}, rng_);
    Scans all(num_scans);
    for (std::size_t i = 0; i < num_scans; ++i) all[i] = i;
    put(all);
    pairs_.clear();
  }
  void put(const Scans& members) {
    component_ = component_of_one(members.front(), s_.scans.size());
    for (const std::size_t i : members) component_.T_reference_scan[i] = s_.scene.T_target_source(members.front(), i);
  }
  void displace(std::size_t i, double angle_rad, double shift_m) {
    auto& T = *component_.T_reference_scan[i];
    T = testing::perturbed(T, s_.scene.scans[i].points, angle_rad, shift_m, rng_);
  }
  /// As if all pairs led to where the scans were put.
  void join_all_as_put(double log_odds) {
    for (std::size_t a = 0; a < s_.scans.size(); ++a) {
      for (std::size_t b = a + 1; b < s_.scans.size(); ++b) {
        pairs_.push_back(
            {a, b, {{component_.T_reference_scan[a]->inverse() * *component_.T_reference_scan[b], log_odds}}});
      }
    }
  }
  void join(std::size_t a, std::size_t b, double log_odds, const Isometry3d& motion = Isometry3d::Identity()) {
    pairs_.push_back({a, b, {{s_.scene.T_target_source(a, b) * motion, log_odds}}});
  }
  void join_all(double log_odds) {
    for (std::size_t a = 0; a < s_.scans.size(); ++a) {
      for (std::size_t b = a + 1; b < s_.scans.size(); ++b) join(a, b, log_odds);
    }
  }
  SettledComponent settled() const {
    std::vector<PointMoments> moments;
    for (const auto& scan : s_.scans) moments.push_back(scan.moments);
    // Its pairs were not compared: nothing contradicts those that overlap.
    const HypothesisSet hypotheses(s_.resolutions.coarse_m, 0.02, moments);
    const PairGraph graph(pairs_, moments, hypotheses.same_m(), options_.inference);
    return settle(s_.scans, hypotheses, graph, s_.resolutions, options_, context_, component_);
  }
  double error_m(const Component& component, std::size_t i) const {
    return testing::pose_rmse_m(s_.scene.T_target_source(component.reference, i), *component.T_reference_scan[i],
                                s_.scene.scans[i].points);
  }

  Rng rng_ = make_stream(1, "settled_component_test");
  testing::PreparedScene s_;
  Component component_;
  std::vector<ComparedPair> pairs_;
  PipelineOptions options_;
  RunContext context_;
};

TEST_F(SettledComponentTest, AllThatFitStayAndFitBetter) {
  see(testing::SyntheticShape::kYard, 4);
  join_all(8);
  const double tolerance = 0.02 * s_.resolutions.fine_m;  // as of the adjustment alone
  for (const std::size_t i : {1u, 2u, 3u}) {
    displace(i, 0.01, 0.1);
    ASSERT_GT(error_m(component_, i), 8 * tolerance);
  }
  options_.decision.confidence = 0.5;
  const SettledComponent out = settled();
  ASSERT_EQ(out.component.size(), 4u);
  EXPECT_EQ(out.pairs.size(), 6u);
  ASSERT_EQ(out.links.size(), 6u);
  ASSERT_EQ(out.uncertainty.poses.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LE(error_m(out.component, i), tolerance) << i;
    ASSERT_TRUE(out.measurements[i]) << "the reference is judged like the others";
    EXPECT_GT(out.measurements[i]->evidence.consensus(), 0.3);
    EXPECT_EQ(out.measurements[i]->num_across, 3u);
    EXPECT_GT(out.measurements[i]->lead, 20) << "three pairs agree";
    EXPECT_FALSE(out.measurements[i]->other_distance);
    EXPECT_EQ(out.decisions[i].reason, Reason::kAccepted);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(std::pair(out.links[k].a, out.links[k].b), out.pairs[k]);
    EXPECT_GT(out.links[k].evidence.consensus(), 0.3);
    EXPECT_TRUE(out.links[k].strength);
  }
  EXPECT_EQ(out.adjustment.lp_status, LpStatus::kOptimal);
}

// In a yard ground alone agrees with ground at a third of the points; rubble has nothing that fits elsewhere.
TEST_F(SettledComponentTest, AMisplacedMemberIsTakenOutAndTheOthersAreNoneTheWorse) {
  for (const std::size_t wrong : {1u, 2u, 3u}) {
    see(testing::SyntheticShape::kRubble, 4);
    displace(wrong, 1.2, 6);  // farther than the adjustment could bring back
    join_all_as_put(8);
    options_.decision.confidence = 0.5;
    const SettledComponent out = settled();
    EXPECT_FALSE(out.component.has(wrong));
    EXPECT_EQ(out.component.size(), 3u) << wrong;
    EXPECT_FALSE(out.decisions[wrong].accepted());
    EXPECT_NE(out.decisions[wrong].reason, Reason::kNotDecided);
    EXPECT_FALSE(out.decisions[wrong].text.empty());
    EXPECT_TRUE(out.measurements[wrong]) << "it says what speaks against it";
    for (const std::size_t i : out.component.members()) {
      EXPECT_LE(error_m(out.component, i), 0.1 * s_.resolutions.fine_m) << i << " without " << wrong;
    }
    for (const auto& [a, b] : out.pairs) EXPECT_TRUE(a != wrong && b != wrong);
  }
}

TEST_F(SettledComponentTest, AMemberGoesBackToWhereItsPairsPutIt) {
  see(testing::SyntheticShape::kRubble, 4);
  join_all(8);
  displace(2, 1.2, 6);
  ASSERT_GT(error_m(component_, 2), 3);
  options_.decision.confidence = 0.5;
  const SettledComponent out = settled();
  ASSERT_EQ(out.component.size(), 4u);
  for (const std::size_t i : {1u, 2u, 3u}) EXPECT_LE(error_m(out.component, i), 0.1 * s_.resolutions.fine_m) << i;
}

// Where the wrong one is the reference, another member becomes it.
TEST_F(SettledComponentTest, TheReferenceIsJudgedLikeTheOthers) {
  see(testing::SyntheticShape::kRubble, 4);
  for (const std::size_t i : {1u, 2u, 3u}) {  // all others are right against one another
    component_.T_reference_scan[i] = Eigen::Translation3d(7, -5, 3) * Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX()) *
                                     *component_.T_reference_scan[i];
  }
  join_all_as_put(8);
  options_.decision.confidence = 0.5;
  const SettledComponent out = settled();
  EXPECT_EQ(out.component.members(), (Scans{1, 2, 3}));
  EXPECT_NE(out.component.reference, 0u);
  EXPECT_TRUE(out.component.T_reference_scan[out.component.reference]->isApprox(Isometry3d::Identity(), 0));
  for (const std::size_t i : {1u, 2u, 3u}) EXPECT_LE(error_m(out.component, i), 0.1 * s_.resolutions.fine_m) << i;
}

// Hung on the others by nothing that the pairs across bear out, two scans fail together, and so may their neighbours.
TEST_F(SettledComponentTest, WhatThePairsAcrossSpeakAgainstLeavesAsAWholeBeforeOthersAreJudged) {
  see(testing::SyntheticShape::kRubble, 6);
  join_all(8);
  std::erase_if(pairs_, [](const ComparedPair& p) { return (p.a < 4) != (p.b < 4); });
  const Isometry3d motion = Eigen::Translation3d(1.5, -1, 0.5) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ());
  for (const std::size_t i : {4u, 5u}) component_.T_reference_scan[i] = motion * *component_.T_reference_scan[i];
  options_.decision.confidence = 0.5;
  const SettledComponent out = settled();
  EXPECT_EQ(out.component.members(), (Scans{0, 1, 2, 3}));
  for (const std::size_t i : {4u, 5u}) {
    EXPECT_FALSE(out.decisions[i].accepted());
    EXPECT_EQ(out.measurements[i]->num_moved, 2u) << "judged while both were there, and not one after the other";
  }
  options_.decision.confidence = 0;
  EXPECT_EQ(settled().component.size(), 6u) << "who asks for all gets all";
}

TEST_F(SettledComponentTest, TheLeadOfAMemberIsThatOfTheWeakestCutThatMovesIt) {
  see(testing::SyntheticShape::kYard, 4);
  join(0, 1, 7);
  join(2, 3, 7);
  const Isometry3d aside(Eigen::Translation3d(6, 0, 0));
  pairs_.push_back({1, 2, {{s_.scene.T_target_source(1, 2), 5}, {s_.scene.T_target_source(1, 2) * aside, 4}}});
  options_.decision.confidence = 0;
  const SettledComponent out = settled();
  ASSERT_EQ(out.component.size(), 4u);
  for (const std::size_t i : {2u, 3u}) {
    const ScanMeasurements& m = *out.measurements[i];
    EXPECT_NEAR(m.lead, 5 - std::log1p(std::exp(4)), 0.01);
    EXPECT_NEAR(m.support, 5, 0.01);
    EXPECT_EQ(m.num_moved, 2u);
    ASSERT_TRUE(m.other_distance);
  }
  // The adjustment has moved scans by far less than a voxel.
  EXPECT_NEAR(*out.measurements[2]->other_distance, 6, s_.resolutions.coarse_m);
  EXPECT_GT(out.measurements[1]->lead, 5);
}

// With the reference at the end of a row, all errors of the row pile up at its other end.
TEST_F(SettledComponentTest, TheScanWithTheMostLinksBecomesTheReference) {
  see(testing::SyntheticShape::kYard, 8, 7);
  put({0, 2, 4});
  join(0, 2, 8);
  join(2, 4, 8);
  options_.decision.confidence = 0;
  options_.reference = "0.ply";
  const SettledComponent named = settled();
  ASSERT_EQ(named.pairs, (ScanPairs{{0, 2}, {2, 4}})) << "a row, not a ring";
  EXPECT_EQ(named.component.reference, 0u) << "the user's choice";
  EXPECT_EQ(named.measurements[2]->num_moved, 2u) << "as seen from the first, with what hangs on it";
  options_.reference.clear();
  const SettledComponent chosen = settled();
  EXPECT_EQ(chosen.component.reference, 2u);
  EXPECT_EQ(chosen.component.members(), (Scans{0, 2, 4}));
  EXPECT_TRUE(chosen.component.T_reference_scan[2]->isApprox(Isometry3d::Identity(), 0));
  // Decisions are about where scans lie to the reference that is reported.
  EXPECT_EQ(chosen.measurements[2]->num_moved, 1u);
  EXPECT_GT(chosen.measurements[2]->lead, named.measurements[2]->lead + 1) << "both pairs hold it";
  for (const std::size_t i : {0u, 4u}) EXPECT_LE(error_m(chosen.component, i), 0.2 * s_.resolutions.fine_m) << i;
}

TEST_F(SettledComponentTest, ScansThatAreNoMembersAreLeftAlone) {
  see(testing::SyntheticShape::kYard, 3);
  put({0, 1});
  join(0, 1, 8);
  options_.decision.confidence = 0;
  const SettledComponent out = settled();
  EXPECT_EQ(out.component.members(), (Scans{0, 1}));
  EXPECT_FALSE(out.measurements[2]);
  EXPECT_EQ(out.decisions[2].reason, Reason::kNotDecided);
}

TEST_F(SettledComponentTest, ThreadsDoNotChangeABit) {
  see(testing::SyntheticShape::kYard, 3);
  join_all(6);
  displace(1, 0.01, 0.1);
  const SettledComponent one = settled();
  context_.num_threads = 2;
  const SettledComponent two = settled();
  ASSERT_EQ(one.component.members(), two.component.members());
  for (const std::size_t i : one.component.members()) {
    EXPECT_TRUE(one.component.T_reference_scan[i]->matrix() == two.component.T_reference_scan[i]->matrix()) << i;
    EXPECT_EQ(one.decisions[i].probability, two.decisions[i].probability) << i;
  }
}

}  // namespace
}  // namespace tcm_icp
