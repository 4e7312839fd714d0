#include "inference/compared_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inference/hypothesis_world.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using testing::HypothesisWorld;
using testing::kSame_m;

std::vector<Eigen::Isometry3d> poses_of(const PairGraph& graph, std::size_t scan, const Component& component) {
  std::vector<Eigen::Isometry3d> poses;
  for (const std::size_t k : graph.pairs_of(scan)) {
    const ComparedPair& pair = graph.pairs()[k];
    if (component.has(pair.a == scan ? pair.b : pair.a)) graph.add_poses(scan, pair, component, poses);
  }
  return poses;
}

class ComparedPairsTest : public ::testing::Test {
 protected:
  double support(double off_m) const {
    return world_.graph().support_of(3, world_.T_target_source(0, 3) * Eigen::Translation3d(0, off_m, 0),
                                     world_.truth({0, 1, 2}));
  }

  // Of a pair of its own, at the truth.
  double support_alone(double log_odds, double off_m, bool implied, double overlap, double weakest_left) {
    HypothesisWorld world(2, rng_);
    PoseHypothesis h = world.aside(0, 1, log_odds, off_m);
    h.implied = implied;
    h.overlap = overlap;
    h.weakest_left = weakest_left;
    world.add(0, 1, {h});
    const PairGraph graph = world.graph();
    return graph.support(graph.pairs()[0], Eigen::Isometry3d::Identity(), world.T_target_source(0, 1));
  }

  Rng rng_ = make_stream(1, "compared_pairs_test");
  HypothesisWorld world_{5, rng_};
  InferenceOptions options_;
};

TEST_F(ComparedPairsTest, AComponentCountsAndListsItsMembers) {
  const Component one = component_of_one(3, 5);
  EXPECT_EQ(one.reference, 3u);
  EXPECT_EQ(one.size(), 1u);
  EXPECT_EQ(one.members(), std::vector<std::size_t>{3});
  EXPECT_TRUE(one.T_reference_scan[3]->isApprox(Eigen::Isometry3d::Identity(), 0));
  EXPECT_FALSE(one.has(2));
  EXPECT_EQ(world_.truth({4, 0, 2}).members(), (std::vector<std::size_t>{0, 2, 4}));
}

// log(1 + e^(l + p)) - p, which is l + log(1 + e^-(l + p)): within e^-(3 + 3) of l from l = 3 on.
TEST_F(ComparedPairsTest, ASingleHypothesisIsWorthItsLogOdds) {
  for (const double log_odds : {3.0, 4.5, 7.0}) {
    HypothesisWorld world(2, rng_);
    world.add(0, 1, {world.hypothesis(0, 1, log_odds)});
    const double support = world.graph().support_of(1, world.T_target_source(0, 1), world.truth({0}));
    EXPECT_NEAR(support, log_odds, 0.0025);
    EXPECT_GE(support, log_odds);
  }
}

TEST_F(ComparedPairsTest, EveryFurtherHypothesisThatAgreesAddsItsLogOddsAndLogPoses) {
  ASSERT_GT(options_.log_poses, 1);
  world_.add(0, 3, {world_.hypothesis(0, 3, 4)});
  const double one = support(0);
  world_.add(1, 3, {world_.aside(1, 3, 5, 0.1 * kSame_m)});
  const double two = support(0);
  EXPECT_NEAR(two - one, 5 + options_.log_poses, 0.001);
  world_.add(2, 3, {world_.aside(2, 3, 3, -0.1 * kSame_m)});
  EXPECT_NEAR(support(0) - two, 3 + options_.log_poses, 0.003);
}

// Fits to one optimum end side by side; wrong poses lie anywhere.
TEST_F(ComparedPairsTest, TheFartherAHypothesisLiesTheLessItSays) {
  const auto alone = [&](double off_m) {
    HypothesisWorld world(2, rng_);
    world.add(0, 1, {world.aside(0, 1, 5, off_m)});
    return world.graph().support_of(1, world.T_target_source(0, 1), world.truth({0}));
  };
  EXPECT_EQ(alone(0.12 * kSame_m), alone(0)) << "nearer than an eighth is near";
  EXPECT_NEAR(alone(0.25 * kSame_m), 5 - options_.log_spread * std::log(2), 0.05);
  EXPECT_NEAR(alone(0.5 * kSame_m), 5 - options_.log_spread * std::log(4), 0.1);
  EXPECT_EQ(alone(1.01 * kSame_m), -options_.log_poses);
}

TEST_F(ComparedPairsTest, AFitThatStartedFromThesePosesSaysLess) {
  world_.add(0, 3, {world_.hypothesis(0, 3, 6)});
  const double one = support(0);
  PoseHypothesis implied = world_.hypothesis(1, 3, 5);
  implied.implied = true;
  world_.add(1, 3, {implied});
  EXPECT_NEAR(support(0) - one, 5 + options_.log_poses - options_.log_implied, 0.01);
}

// Fits from the right pose end elsewhere where nothing holds them: that little shows there says little against it.
TEST_F(ComparedPairsTest, AFitThatSlidAwayCountsLittleAgainst) {
  const auto says = [&](double left, double log_odds, double off_m, bool implied = true) {
    return support_alone(log_odds, off_m, implied, 1, left);
  };
  const double firm = options_.firm_left, loose = options_.loose_left, near_m = kSame_m / 8, far_m = 3 * near_m;
  ASSERT_LT(options_.log_missed + options_.log_slid * std::log(3), 0);
  EXPECT_NEAR(says(firm, -20, far_m), options_.log_missed, 1e-6);
  EXPECT_NEAR(says(loose, -20, near_m / 2), options_.log_missed, 1e-6) << "it did not slide";
  EXPECT_NEAR(says(loose, -20, far_m), options_.log_missed + options_.log_slid * std::log(3), 1e-6);
  EXPECT_NEAR(says((firm + loose) / 2, -20, far_m), options_.log_missed + options_.log_slid * std::log(3) / 2, 1e-6);
  EXPECT_NEAR(says(2, -20, far_m), says(loose, -20, far_m), 1e-9);
  EXPECT_NEAR(says(2, -20, 0.99 * kSame_m), 0, 1e-6) << "never for it";
  EXPECT_NEAR(says(loose, 6, far_m), says(firm, 6, far_m), 0.1) << "what it shows counts as it did";
  EXPECT_NEAR(says(2, 1, far_m, false), says(0, 1, far_m, false), 1e-9) << "of a search";
}

// Fits from right poses slide away; what the pair shows there is known once it was measured there.
TEST_F(ComparedPairsTest, WhatAPairWasMeasuredAtCountsForThosePosesAndAgainstThem) {
  HypothesisWorld world(2, rng_);
  PoseHypothesis slid = world.aside(0, 1, 2, 0.4 * kSame_m);
  slid.implied = true;
  world.add(0, 1, {slid});
  const PairGraph without = world.graph();
  const auto support = [&](const PairGraph& graph, double off_m) {
    return graph.support(graph.pairs()[0], Eigen::Isometry3d::Identity(),
                         world.T_target_source(0, 1) * Eigen::Translation3d(0, off_m, 0));
  };
  const auto measured = [&](double log_odds) {
    PoseHypothesis h = world.hypothesis(0, 1, log_odds);
    h.implied = h.is_there = true;
    h.overlap = 0.05;
    h.weakest_left = 2;
    return without.with({{0, 1, {h}}});
  };
  const double by_chance = options_.log_poses - options_.log_implied, missed = options_.log_missed_there;
  ASSERT_LT(missed, options_.log_missed);
  for (const double log_odds : {-20.0, -2.0, 0.0, 3.0}) {
    const PairGraph with = measured(log_odds);
    ASSERT_EQ(with.pairs().size(), 1u);
    EXPECT_NEAR(support(with, 0), std::log(std::exp(missed) + std::exp(log_odds + by_chance)), 1e-6) << log_odds;
    EXPECT_LE(support(with, 0), with.pairs()[0].hypotheses[1].most_support + 1e-9);
    const Component both = world.truth({0, 1});
    EXPECT_NEAR(
        with.support_across(with.pairs()[0], *both.T_reference_scan[0], *both.T_reference_scan[1], 0, 1).support,
        support(with, 0), 1e-9);
    for (const double off_m : {0.2 * kSame_m, 0.4 * kSame_m, 2 * kSame_m}) {
      EXPECT_EQ(support(with, off_m), support(without, off_m)) << "of other poses it says nothing";
    }
  }
  EXPECT_NEAR(support(measured(-20), 0), missed, 1e-6) << "whatever a fit that slid away shows";
}

TEST_F(ComparedPairsTest, WhatASearchFoundCountsThoughLittleIsMeasuredThere) {
  HypothesisWorld world(2, rng_);
  world.add(0, 1, {world.hypothesis(0, 1, 4)});
  PoseHypothesis h = world.hypothesis(0, 1, -5);
  h.implied = h.is_there = true;
  const PairGraph with = world.graph().with({{0, 1, {h}}});
  EXPECT_DOUBLE_EQ(with.support(with.pairs()[0], Eigen::Isometry3d::Identity(), world.T_target_source(0, 1)),
                   std::log1p(std::exp(4 + options_.log_poses)));
}

TEST_F(ComparedPairsTest, FurtherHypothesesMayBeOfPairsThatWereNotCompared) {
  world_.add(0, 3, {world_.hypothesis(0, 3, 4)});
  const PairGraph graph = world_.graph(), with = graph.with({{1, 2, {world_.hypothesis(1, 2, 5)}}});
  ASSERT_EQ(graph.pairs().size(), 1u);
  ASSERT_EQ(with.pairs().size(), 2u);
  EXPECT_EQ(with.pairs_of(1), std::vector<std::size_t>{1});
  EXPECT_EQ(with.pairs()[1].hypotheses[0].log_odds, 5);
  EXPECT_EQ(with.num_scans(), graph.num_scans());
}

// By it places are left out that cannot be the best.
TEST_F(ComparedPairsTest, NoPosesSupportAHypothesisByMoreThanItsMost) {
  for (const double log_odds : {-4.0, -0.5, 0.0, 2.0}) {
    for (const double left : {0.3, 0.7, 1.5}) {
      HypothesisWorld world(2, rng_);
      PoseHypothesis h = world.hypothesis(0, 1, log_odds);
      h.implied = true;
      h.weakest_left = left;
      world.add(0, 1, {h});
      const PairGraph graph = world.graph();
      for (double off_m = 0; off_m < kSame_m; off_m += 0.05) {
        const Eigen::Isometry3d T_b = world.T_target_source(0, 1) * Eigen::Translation3d(0, off_m, 0);
        EXPECT_LE(graph.support(graph.pairs()[0], Eigen::Isometry3d::Identity(), T_b),
                  graph.pairs()[0].hypotheses[0].most_support + 1e-9);
      }
    }
  }
}

// At the right pose, too, what hardly overlaps shows nothing.
TEST_F(ComparedPairsTest, AFitOfWhatHardlyOverlapsCountsLittleForOrAgainst) {
  const auto says = [&](double overlap, double log_odds) { return support_alone(log_odds, 0, true, overlap, 0); };
  const double telling = options_.telling_overlap;
  EXPECT_NEAR(says(1, -20), options_.log_missed, 1e-6);
  EXPECT_EQ(says(telling, -20), says(1, -20));
  EXPECT_NEAR(says(telling / 2, -20), options_.log_missed / 2, 1e-6);
  EXPECT_EQ(says(0, -20), 0);
  EXPECT_EQ(says(0, 5), 0);
  EXPECT_GT(says(telling / 2, 5), 4) << "what shows counts all the same";
  EXPECT_LT(says(telling / 2, 5), says(1, 5));
  EXPECT_LT(says(telling / 2, -1), says(telling / 2, 0));
}

// Two of them by chance at one place of e^3 is less likely than either being right.
TEST_F(ComparedPairsTest, WeakHypothesesThatAgreeAreWorthMoreThanTheirSum) {
  world_.add(0, 3, {world_.hypothesis(0, 3, -1)});
  EXPECT_LT(support(0), 0);
  world_.add(1, 3, {world_.hypothesis(1, 3, -1)});
  EXPECT_GT(support(0), 0);
}

TEST_F(ComparedPairsTest, HypothesesThatLeadElsewhereCountNothing) {
  world_.add(0, 3, {world_.hypothesis(0, 3, 4)});
  const double alone = support(0);
  world_.add(1, 3, {world_.aside(1, 3, 8, 10)});
  world_.add(2, 3, {});
  world_.add(3, 4, {world_.aside(3, 4, 8, 10)});  // of a scan that is no member
  EXPECT_EQ(support(0), alone);
  EXPECT_NEAR(support(10), 8, 0.001);
  EXPECT_EQ(support(30), -options_.log_poses) << "where none leads";
}

TEST_F(ComparedPairsTest, OfAPairsOwnHypothesesTheLikeliestThatAgreesCounts) {
  world_.add(0, 3, {world_.aside(0, 3, 8, 10), world_.aside(0, 3, 3, 0.1 * kSame_m), world_.hypothesis(0, 3, 5)});
  EXPECT_NEAR(support(0), 5, 0.001);
}

TEST_F(ComparedPairsTest, NoPairIsSurerThanTheMost) {
  world_.add(0, 3, {world_.hypothesis(0, 3, options_.most_log_odds)});
  world_.add(1, 3, {world_.aside(1, 3, 1e9, 10)});
  EXPECT_EQ(support(10), support(0));
  EXPECT_TRUE(std::isfinite(support(10)));
}

TEST_F(ComparedPairsTest, SupportOfAPairIsOfTheirPosesAgainstEachOther) {
  world_.add(1, 3, {world_.hypothesis(1, 3, 4)});
  const PairGraph graph = world_.graph();
  const auto support = [&](const Eigen::Isometry3d& T_frame, double off_m) {
    return graph.support(graph.pairs()[0], T_frame * world_.T_target_source(0, 1),
                         T_frame * world_.T_target_source(0, 3) * Eigen::Translation3d(0, off_m, 0));
  };
  const Eigen::Isometry3d anywhere = testing::random_pose(30, rng_);
  EXPECT_DOUBLE_EQ(support(Eigen::Isometry3d::Identity(), 0), std::log1p(std::exp(4 + options_.log_poses)));
  EXPECT_DOUBLE_EQ(support(anywhere, 0), support(Eigen::Isometry3d::Identity(), 0));
  EXPECT_GT(support(anywhere, 0.9 * kSame_m), 0);
  EXPECT_EQ(support(anywhere, 1.1 * kSame_m), 0);
}

// The same hypothesis serves both of its scans: T_a_b one way, its inverse the other.
TEST_F(ComparedPairsTest, EitherScanOfAPairIsLedToByTheOther) {
  world_.add(1, 3, {world_.hypothesis(1, 3, 4)});
  for (const auto& [fixed, scan] : {std::pair(1u, 3u), std::pair(3u, 1u)}) {
    const auto poses = poses_of(world_.graph(), scan, world_.truth({fixed}));
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_TRUE(testing::is_pose_near(world_.T_target_source(fixed, scan), poses[0], 1e-9, 1e-9));
    EXPECT_NEAR(world_.graph().support_of(scan, poses[0], world_.truth({fixed})), 4, 0.001);
  }
}

TEST_F(ComparedPairsTest, PosesOfAScanComeOnceInTheOrderOfThePairs) {
  world_.add(0, 3, {world_.aside(0, 3, 1, 10), world_.hypothesis(0, 3, 5)});
  world_.add(1, 3, {world_.aside(1, 3, 8, 0.1 * kSame_m), world_.aside(1, 3, 2, -20)});
  world_.add(3, 4, {world_.aside(3, 4, 8, 30)});  // no member
  const auto poses = poses_of(world_.graph(), 3, world_.truth({0, 1, 2}));
  ASSERT_EQ(poses.size(), 3u) << "poses less than an eighth of same_m apart are one";
  const std::vector<double> off_m{10, 0, -20};
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Isometry3d expected = world_.T_target_source(0, 3) * Eigen::Translation3d(0, off_m[k], 0);
    EXPECT_TRUE(testing::is_pose_near(expected, poses[k], 1e-9, 1e-9)) << k;
  }
}

// Of what agrees, by how much it pulls; what lies elsewhere pulls not at all.
TEST_F(ComparedPairsTest, TheMeanPoseLiesBetweenHypothesesThatAgree) {
  const Component others = world_.truth({0, 1, 2});
  const Eigen::Isometry3d T = world_.T_target_source(0, 3);
  const auto off_m = [&](const Eigen::Isometry3d& U) -> Eigen::Vector3d { return (T.inverse() * U).translation(); };
  EXPECT_EQ(off_m(world_.graph().mean_pose(3, T, others)), Eigen::Vector3d::Zero()) << "nothing agrees";
  world_.add(0, 3, {world_.aside(0, 3, 5, 0.3 * kSame_m)});
  world_.add(1, 3, {world_.aside(1, 3, 5, -0.3 * kSame_m), world_.aside(1, 3, 8, 5 * kSame_m)});
  EXPECT_LT(off_m(world_.graph().mean_pose(3, T, others)).norm(), 0.01 * kSame_m);
  world_.add(2, 3, {world_.aside(2, 3, -1.5, 0.3 * kSame_m)});
  const Eigen::Vector3d moved_m = off_m(world_.graph().mean_pose(3, T, others));
  EXPECT_GT(moved_m.y(), 0.02 * kSame_m);
  EXPECT_LT(moved_m.y(), 0.1 * kSame_m) << "an unlikely one pulls less";
}

TEST_F(ComparedPairsTest, TheMeanPoseOfOneHypothesisIsItsOwn) {
  for (const bool first : {false, true}) {
    HypothesisWorld world(2, rng_);
    const PoseHypothesis h = world.noisy(0, 1, 5, 0.01, 0.1, rng_);
    world.add(0, 1, {h});
    const std::size_t scan = first ? 0 : 1;
    const Component other = world.truth({1 - scan});
    const Eigen::Isometry3d mean = world.graph().mean_pose(scan, world.T_target_source(1 - scan, scan), other);
    EXPECT_TRUE(testing::is_pose_near(mean, first ? h.T_a_b.inverse() : h.T_a_b, 1e-9, 1e-9));
  }
}

TEST_F(ComparedPairsTest, WhatCanChangeNothingIsLeftOut) {
  world_.add(0, 1, {world_.hypothesis(0, 1, -50), world_.hypothesis(0, 1, 2)});
  world_.add(0, 2, {world_.hypothesis(0, 2, -50)});
  world_.add(1, 2, {});
  const PairGraph graph = world_.graph();
  ASSERT_EQ(graph.pairs().size(), 1u);
  EXPECT_EQ(graph.pairs()[0].hypotheses.size(), 1u);
  EXPECT_EQ(graph.pairs_of(0), std::vector<std::size_t>{0});
  EXPECT_TRUE(graph.pairs_of(2).empty());
}

}  // namespace
}  // namespace tcm_icp
