#include "pipeline/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/link_score.hpp"
#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kSame_m = 1;

// Five scans in frames of their own, and links between them as a pair search would have found them.
class PoseGraphTest : public ::testing::Test {
 protected:
  PoseGraphTest() {
    for (int i = 0; i < 5; ++i) truth_.push_back(testing::random_pose(50, rng_));
    truth_[0].setIdentity();  // the reference
    points_ = testing::random_points(50, 20, rng_);
  }

  /// T_a_b as the poses have it, with scan b put `off_m` to the side.
  LinkHypothesis hypothesis(std::size_t a, std::size_t b, double log_odds, double off_m = 0) const {
    LinkHypothesis h;
    h.T_a_b = truth_[a].inverse() * truth_[b] * Eigen::Translation3d(0, off_m, 0);
    h.log_odds = log_odds;
    return h;
  }
  void add(std::size_t a, std::size_t b, std::vector<LinkHypothesis> hypotheses) {
    graph_.add({a, b, std::move(hypotheses)});
  }
  std::vector<StartPose> starts(std::size_t scan, const std::vector<bool>& placed) const {
    return graph_.start_poses(scan, placed, truth_, points_, kSame_m);
  }

  Rng rng_ = make_stream(1, "pose_graph_test");
  std::vector<Isometry3d> truth_;
  Points points_;
  PoseGraph graph_{5};
  const std::vector<bool> others_placed_{true, true, true, false, false};
};

TEST_F(PoseGraphTest, LinksThatLeadToOnePlaceAddUp) {
  add(0, 3, {hypothesis(0, 3, 2)});
  add(1, 3, {hypothesis(1, 3, 4, 0.4 * kSame_m)});
  add(2, 3, {hypothesis(2, 3, 1, -0.4 * kSame_m)});
  const auto poses = starts(3, others_placed_);
  ASSERT_EQ(poses.size(), 1u) << "poses less than same_m apart are one";
  EXPECT_DOUBLE_EQ(poses[0].log_odds, 7);
  EXPECT_EQ(poses[0].num_links, 3u);
  const Isometry3d of_likeliest = truth_[3] * Eigen::Translation3d(0, 0.4 * kSame_m, 0);
  EXPECT_TRUE(testing::is_pose_near(of_likeliest, poses[0].T_reference_scan, 1e-9, 1e-9));
}

// Four scans, all pairs linked. One wrong link contradicts two loops, two of the others'.
TEST_F(PoseGraphTest, LoopsTellALinkThatContradictsTheOthers) {
  const std::vector<PointMoments> points(5, PointMoments(points_));
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) add(a, b, {hypothesis(a, b, 8, a == 0 && b == 1 ? 9 : 0)});
  }
  add(3, 4, {hypothesis(3, 4, 8)});
  add(2, 4, {hypothesis(2, 4, 2)});
  graph_.weigh_by_loops(points, kSame_m);
  const auto trust = [&](std::size_t a, std::size_t b) { return graph_.links().at({a, b}).trust; };
  EXPECT_EQ(trust(0, 1), 0) << "none of its two loops closes";
  // Two of the set's four loops close, (2 + 2) / (2 + 4) with the prior: what stands in where a link has few.
  const auto share = [](double closed, double all) { return (closed + 2 * 4 / 6.0) / (all + 2); };
  const auto trust_of = [](double s) { return (s - 0.5) / 0.4; };
  const double of_the_set = trust_of(4 / 6.0);
  EXPECT_NEAR(trust(0, 2), of_the_set * trust_of(share(1, 1)), 1e-12) << "its loop with 0 to 1 is not held against it";
  EXPECT_NEAR(trust(2, 3), of_the_set * trust_of(share(2, 2)), 1e-12);
  EXPECT_NEAR(trust(3, 4), of_the_set * trust_of(share(0, 0)), 1e-12) << "no loop of clear links";
  EXPECT_DOUBLE_EQ(starts(1, {true, false, false, false, false})[0].log_odds, 0);
}

TEST_F(PoseGraphTest, LoopsThatCloseLeaveAllAsItWas) {
  const std::vector<PointMoments> points(5, PointMoments(points_));
  for (std::size_t a = 0; a < 5; ++a) {
    for (std::size_t b = a + 1; b < 5; ++b) add(a, b, {hypothesis(a, b, 4, 0.3 * kSame_m)});
  }
  graph_.weigh_by_loops(points, kSame_m);
  for (const auto& [pair, link] : graph_.links()) EXPECT_EQ(link.trust, 1);
}

TEST_F(PoseGraphTest, WithoutLoopsLinksStandByThemselves) {
  const std::vector<PointMoments> points(5, PointMoments(points_));
  add(0, 1, {hypothesis(0, 1, 4)});
  add(1, 2, {hypothesis(1, 2, 4, 9)});
  add(0, 2, {hypothesis(0, 2, 2)});
  graph_.weigh_by_loops(points, kSame_m);
  for (const auto& [pair, link] : graph_.links()) EXPECT_EQ(link.trust, 1) << "0 and 2 have no clear link";
}

// In a place that repeats itself links err alike: what speaks against a pose stays, what speaks for it goes.
TEST_F(PoseGraphTest, WhereNoLoopClosesNothingIsBelieved) {
  const std::vector<PointMoments> points(5, PointMoments(points_));
  for (std::size_t a = 0; a < 5; ++a) {
    for (std::size_t b = a + 1; b < 5; ++b) {
      const double off_m = 9.0 * static_cast<double>(1 + a * 5 + b);
      add(a, b, {hypothesis(a, b, 9, off_m), hypothesis(a, b, -2, 0)});
    }
  }
  graph_.weigh_by_loops(points, kSame_m);
  for (const auto& [pair, link] : graph_.links()) {
    EXPECT_EQ(link.trust, 0);
    EXPECT_EQ(link.log_odds(link.hypotheses[0]), 0);
    EXPECT_EQ(link.log_odds(link.hypotheses[1]), -2);
  }
}

// Links that free space could have vetoed stand, where links that it said nothing of contradict them.
TEST_F(PoseGraphTest, LinksThatPassedFreeSpaceAreNotContradictedByOthers) {
  const std::vector<PointMoments> points(5, PointMoments(points_));
  const auto judged = [&](std::size_t a, std::size_t b) {
    LinkHypothesis h = hypothesis(a, b, 8);
    h.free_space.num_points = 1000;
    return h;
  };
  add(0, 1, {judged(0, 1)});
  add(1, 2, {judged(1, 2)});
  add(0, 2, {hypothesis(0, 2, 8, 9)});
  add(2, 3, {hypothesis(2, 3, 8)});
  graph_.weigh_by_loops(points, kSame_m);
  EXPECT_EQ(graph_.links().at({0, 1}).trust, 1);
  EXPECT_EQ(graph_.links().at({1, 2}).trust, 1);
  EXPECT_EQ(graph_.links().at({0, 2}).trust, 0);
  EXPECT_LT(graph_.links().at({2, 3}).trust, 1) << "as its set, none of whose loops closes";
}

// What free space bears out stands, where links contradict it that it spoke against, if not loudly enough for a veto.
TEST_F(PoseGraphTest, LinksThatFreeSpaceBearsOutAreNotContradictedByOthers) {
  const std::vector<PointMoments> points(5, PointMoments(points_));
  const auto judged = [&](std::size_t a, std::size_t b, std::size_t num_violating, double off_m = 0) {
    LinkHypothesis h = hypothesis(a, b, 8, off_m);
    h.free_space.num_points = 1000;
    h.free_space.num_violating = num_violating;
    return h;
  };
  add(0, 1, {judged(0, 1, 2)});
  add(1, 2, {judged(1, 2, 2)});
  add(0, 2, {judged(0, 2, 15, 9)});
  graph_.weigh_by_loops(points, kSame_m);
  EXPECT_EQ(graph_.links().at({0, 1}).trust, 1);
  EXPECT_EQ(graph_.links().at({1, 2}).trust, 1);
  EXPECT_EQ(graph_.links().at({0, 2}).trust, 0);
}

// The same link serves both of its scans: T_a_b one way, its inverse the other.
TEST_F(PoseGraphTest, EitherScanOfALinkCanBePlacedByTheOther) {
  add(1, 3, {hypothesis(1, 3, 4)});
  const auto third = starts(3, {false, true, false, false, false});
  const auto first = starts(1, {false, false, false, true, false});
  ASSERT_EQ(third.size(), 1u);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_TRUE(testing::is_pose_near(truth_[3], third[0].T_reference_scan, 1e-9, 1e-9));
  EXPECT_TRUE(testing::is_pose_near(truth_[1], first[0].T_reference_scan, 1e-9, 1e-9));
}

TEST_F(PoseGraphTest, OnlyLinksToPlacedScansCount) {
  add(0, 3, {hypothesis(0, 3, 2)});
  add(3, 4, {hypothesis(3, 4, 9, 30)});
  add(1, 2, {hypothesis(1, 2, 9)});
  const auto poses = starts(3, others_placed_);
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_DOUBLE_EQ(poses[0].log_odds, 2);
  EXPECT_EQ(graph_.num_hypotheses(3, others_placed_), 1u);
  EXPECT_EQ(graph_.num_hypotheses(3, {true, true, true, true, true}), 2u);
  EXPECT_TRUE(starts(4, others_placed_).empty()) << "its only neighbour is not placed";
}

TEST_F(PoseGraphTest, LinksThatLeadElsewhereCountAgainstAPose) {
  add(0, 3, {hypothesis(0, 3, 3)});
  add(1, 3, {hypothesis(1, 3, 5)});
  add(2, 3, {hypothesis(2, 3, 6, 10)});
  const auto poses = starts(3, others_placed_);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_DOUBLE_EQ(poses[0].log_odds, 3 + 5 - (6 - kDoubtLogOdds)) << "two weak links outdo a strong one";
  EXPECT_EQ(poses[0].num_links, 2u);
  EXPECT_TRUE(testing::is_pose_near(truth_[3], poses[0].T_reference_scan, 1e-9, 1e-9));
  EXPECT_DOUBLE_EQ(poses[1].log_odds, 6 - (3 - kDoubtLogOdds) - (5 - kDoubtLogOdds));
  EXPECT_EQ(poses[1].num_links, 1u);
}

// A pair that cannot tell two poses apart supports both; it speaks against one only by how much the other is likelier.
TEST_F(PoseGraphTest, APairsOwnAlternativesCountByHowMuchTheyOutdo) {
  add(0, 3, {hypothesis(0, 3, 3), hypothesis(0, 3, 5, 10)});
  const auto poses = starts(3, others_placed_);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_DOUBLE_EQ(poses[0].log_odds, 5) << "the weaker alternative takes nothing away";
  EXPECT_DOUBLE_EQ(poses[1].log_odds, 3 - (5 - 3));
  EXPECT_TRUE(testing::is_pose_near(truth_[3], poses[1].T_reference_scan, 1e-9, 1e-9));
}

// What one pair cannot decide another does.
TEST_F(PoseGraphTest, ASecondPairDecidesBetweenAlternatives) {
  add(0, 3, {hypothesis(0, 3, 3), hypothesis(0, 3, 4, 10)});
  ASSERT_FALSE(testing::is_pose_near(truth_[3], starts(3, others_placed_)[0].T_reference_scan, 0.1, 1));
  add(1, 3, {hypothesis(1, 3, 2.5)});
  const auto poses = starts(3, others_placed_);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_TRUE(testing::is_pose_near(truth_[3], poses[0].T_reference_scan, 1e-9, 1e-9));
  EXPECT_DOUBLE_EQ(poses[0].log_odds, 3 - 1 + 2.5);
  EXPECT_DOUBLE_EQ(poses[1].log_odds, 4 - (2.5 - kDoubtLogOdds));
}

TEST_F(PoseGraphTest, AnUnlikelyLinkNeitherHelpsNorHarms) {
  add(0, 3, {hypothesis(0, 3, 4)});
  add(1, 3, {hypothesis(1, 3, -7)});
  add(2, 3, {hypothesis(2, 3, -2, 10)});
  const auto poses = starts(3, others_placed_);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_DOUBLE_EQ(poses[0].log_odds, 4);
  EXPECT_EQ(poses[0].num_links, 2u) << "both lead there, whatever they weigh";
  EXPECT_DOUBLE_EQ(poses[1].log_odds, -(4 - kDoubtLogOdds));
}

TEST_F(PoseGraphTest, SupportIsAskedOfAnyPose) {
  add(0, 3, {hypothesis(0, 3, 3)});
  add(1, 3, {hypothesis(1, 3, 5, 10)});
  const auto support = [&](double off_m) {
    auto poses = truth_;
    poses[3] = truth_[3] * Eigen::Translation3d(0, off_m, 0);
    return graph_.support(3, others_placed_, poses, points_, kSame_m);
  };
  EXPECT_DOUBLE_EQ(support(0.2).log_odds, 3 - (5 - kDoubtLogOdds));
  EXPECT_DOUBLE_EQ(support(10.2).log_odds, 5 - (3 - kDoubtLogOdds));
  EXPECT_EQ(support(10.2).num_links, 1u);
  EXPECT_DOUBLE_EQ(support(-30).log_odds, -(3 - kDoubtLogOdds) - (5 - kDoubtLogOdds))
      << "where no link leads all speak against";
  EXPECT_EQ(support(-30).num_links, 0u);
  const auto alone = graph_.support(4, others_placed_, truth_, points_, kSame_m);
  EXPECT_EQ(alone.log_odds, 0);
  EXPECT_EQ(alone.num_links, 0u);
}

TEST_F(PoseGraphTest, LaterHypothesesOfAPairJoinItsOwn) {
  add(0, 3, {hypothesis(0, 3, 1)});
  add(0, 3, {hypothesis(0, 3, 6, 10), hypothesis(0, 3, -1, 20)});
  ASSERT_EQ(graph_.links().size(), 1u);
  const auto& hypotheses = graph_.links().begin()->second.hypotheses;
  ASSERT_EQ(hypotheses.size(), 3u);
  EXPECT_EQ(hypotheses[0].log_odds, 6);
  EXPECT_EQ(hypotheses[1].log_odds, 1);
  EXPECT_EQ(hypotheses[2].log_odds, -1);
}

TEST_F(PoseGraphTest, GroupsAreHeldTogetherByClearLinksAlone) {
  EXPECT_EQ(graph_.outside_of_largest_group(), (std::vector<bool>{false, true, true, true, true}))
      << "without links the first scan is a group, and no smaller than others";
  add(1, 2, {hypothesis(1, 2, kClearLogOdds)});
  add(2, 4, {hypothesis(2, 4, -1), hypothesis(2, 4, kClearLogOdds + 2)});
  add(0, 3, {hypothesis(0, 3, kClearLogOdds + 5)});
  add(3, 4, {hypothesis(3, 4, kClearLogOdds - 0.01)});
  add(0, 1, {});  // tried in vain
  graph_.add({2, 4, {}});
  EXPECT_EQ(graph_.outside_of_largest_group(), (std::vector<bool>{true, false, false, true, false}));
}

TEST_F(PoseGraphTest, TheCorrespondenceGraphHasLinksMoreLikelyRightThanWrong) {
  add(0, 1, {hypothesis(0, 1, 2), hypothesis(0, 1, 1, 10)});
  add(1, 2, {hypothesis(1, 2, 0.1)});
  add(2, 3, {hypothesis(2, 3, -0.1)});
  add(1, 4, {hypothesis(1, 4, 8)});
  add(0, 3, {});
  const CorrespondenceGraph all = graph_.correspondence_graph(std::vector<bool>(5, true));
  EXPECT_DOUBLE_EQ(all.measure(0, 1), 1 - 1 / (1 + std::exp(-2.0))) << "by the likeliest hypothesis";
  EXPECT_EQ(all.measure(0, 1), all.measure(1, 0));
  EXPECT_EQ(all.measure(2, 3), 1);
  EXPECT_EQ(all.adjacency[1], (std::vector<std::size_t>{0, 2, 4}));
  EXPECT_EQ(all.degree(3), 0u);
  EXPECT_EQ(all.reference, 1u);
  const CorrespondenceGraph some = graph_.correspondence_graph({true, true, true, true, false});
  EXPECT_EQ(some.adjacency[1], (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(some.degree(4), 0u);
}

}  // namespace
}  // namespace tcm_icp
