#include "inference/cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "inference/hypothesis_world.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::HypothesisWorld;
using Scans = std::vector<std::size_t>;

using testing::kRounding;

// Of log(1 + e^(l + 3)) - 3 against l, from l = 3 on.
constexpr double kOfLogOdds = 0.0025;

// Of another place, beside that all hypotheses are wrong.
double with_none(double log_odds) { return std::log1p(std::exp(log_odds)); }

class CutsTest : public ::testing::Test {
 protected:
  void add(std::size_t a, std::size_t b, double log_odds) { world_.add(a, b, {world_.hypothesis(a, b, log_odds)}); }
  static const Cut* find(const std::vector<Cut>& cuts, const Scans& moved) {
    const auto cut = std::find_if(cuts.begin(), cuts.end(), [&](const Cut& c) { return c.moved == moved; });
    return cut == cuts.end() ? nullptr : &*cut;
  }

  Rng rng_ = make_stream(1, "cuts_test");
  HypothesisWorld world_{6, rng_};
  InferenceOptions options_;
};

TEST_F(CutsTest, TheLeadOfAScanWithNoOtherPlaceIsItsSupport) {
  add(0, 1, 6);
  add(0, 2, 4);
  add(1, 2, 5);
  const Component component = world_.truth({0, 1, 2});
  const Cut cut = measure_cut(world_.graph(), component, {2});
  EXPECT_EQ(cut.moved, Scans{2});
  EXPECT_NEAR(cut.support, 4 + 5 + options_.log_poses, kOfLogOdds);
  EXPECT_EQ(cut.lead(), cut.support);
  EXPECT_FALSE(cut.other_motion);
  EXPECT_DOUBLE_EQ(cut.support, world_.graph().support_of(2, *component.T_reference_scan[2], component));
}

TEST_F(CutsTest, TheOtherPlaceOfAScanLowersItsLead) {
  add(0, 1, 6);
  add(0, 2, 6);
  world_.add(1, 2, {world_.aside(1, 2, 4, 7)});
  const Component component = world_.truth({0, 1, 2});
  const Cut cut = measure_cut(world_.graph(), component, {2});
  EXPECT_NEAR(cut.support, 6, kOfLogOdds);
  EXPECT_NEAR(cut.other_support, 4, kOfLogOdds);
  EXPECT_NEAR(cut.lead(), 6 - with_none(4), 2 * kOfLogOdds);
  ASSERT_TRUE(cut.other_motion);
  const Isometry3d& T = *component.T_reference_scan[2];
  EXPECT_TRUE(testing::is_pose_near(T * Eigen::Translation3d(0, 7, 0), *cut.other_motion * T, kRounding, kRounding));
  EXPECT_NEAR(rms_displacement(T.inverse() * *cut.other_motion * T, world_.points()), 7, kRounding);
}

// Halves of a building that look alike: every pair across finds the same wrong place, and each shows a little that
// speaks against it. Searches that agree are no coincidence there.
TEST_F(CutsTest, ManyPairsThatAreUnlikelyAreATwin) {
  for (const double log_odds : {-2.0, 2.0}) {
    HypothesisWorld world(8, rng_);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 4; b < 8; ++b) world.add(a, b, {world.hypothesis(a, b, log_odds)});
    }
    const Cut cut = measure_cut(world.graph(), world.truth({0, 1, 2, 3, 4, 5, 6, 7}), {4, 5, 6, 7});
    const double by_chance = 16 * std::log(1 + std::exp(log_odds + options_.log_poses)) - options_.log_poses;
    const double by_twin =
        16 * std::log(std::exp(options_.log_missed) + std::exp(log_odds + options_.log_poses - options_.log_implied)) +
        options_.log_twins;
    EXPECT_GT(by_chance, 10) << "as a coincidence it is clear either way";
    EXPECT_NEAR(cut.support, by_twin, kRounding);
    EXPECT_EQ(cut.support > 0, log_odds > 0);
  }
}

// A constant that only the pairs across have taught is no reason to believe them; one that other pairs teach, too, is.
TEST_F(CutsTest, WhatPairsAtATwinTeachIsNothingAgainstIt) {
  constexpr double kAlone = -2, kTaught = 3;
  const auto support = [&](bool others_teach_it) {
    HypothesisWorld world(8, rng_);
    std::vector<ComparedPair> pairs;
    for (std::size_t a = 0; a < 8; ++a) {
      for (std::size_t b = a + 1; b < 8; ++b) {
        const bool is_across = a < 4 && b >= 4;
        ComparedPair pair{a, b, {world.hypothesis(a, b, kAlone + kTaught)}, {}};
        pair.hypotheses[0].taught = kTaught;
        if (is_across || others_teach_it) pair.teachers.assign(3, {kAlone, true, 1});
        pairs.push_back(pair);
      }
    }
    return measure_cut(world.graph(pairs), world.truth({0, 1, 2, 3, 4, 5, 6, 7}), {4, 5, 6, 7}).support;
  };
  EXPECT_LT(support(false), 0);
  EXPECT_GT(support(true), 10);
}

TEST_F(CutsTest, FewPairsDoNotChangeASetsConstant) {
  std::vector<ComparedPair> pairs;
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = a + 1; b < 6; ++b) {
      pairs.push_back({a, b, {world_.hypothesis(a, b, 1)}, std::vector<JudgedHypothesis>(a == 0 && b == 1 ? 1 : 9)});
    }
  }
  const PairGraph graph = world_.graph(pairs);
  EXPECT_EQ(graph.constant_without({0}), std::numeric_limits<double>::infinity());
  std::vector<JudgedHypothesis> others(1 + 12 * 9);  // of the first pair, and of those behind the third
  EXPECT_DOUBLE_EQ(graph.constant_without({1, 2}), set_constant(others, options_.set_spread));
}

// One link is worth what it says: nothing has to agree with it.
TEST_F(CutsTest, ASingleLinkIsNoTwin) {
  for (const double log_odds : {0.5, 3.0, 7.0}) {
    HypothesisWorld world(2, rng_);
    world.add(0, 1, {world.hypothesis(0, 1, log_odds)});
    const Component component = world.truth({0, 1});
    EXPECT_EQ(measure_cut(world.graph(), component, {1}).support,
              world.graph().support_of(1, *component.T_reference_scan[1], component));
  }
}

// Less likely than that all hypotheses across are wrong.
TEST_F(CutsTest, AnotherPlaceThatIsNoneTakesLittleAway) {
  add(0, 1, 6);
  world_.add(0, 1, {world_.aside(0, 1, -1, 7)});
  const Cut cut = measure_cut(world_.graph(), world_.truth({0, 1}), {1});
  EXPECT_FALSE(cut.other_motion);
  EXPECT_EQ(cut.other_support, 0);
  EXPECT_NEAR(cut.lead(), cut.support - with_none(-1), kRounding);
}

// Nineteen pairs of the two scans that hold were compared in vain: that the best of them says something is no wonder.
// How many other scans the two sides have does not matter.
TEST_F(CutsTest, ManyPlacesThatAreUnlikelyEachAreLikelyTogether) {
  constexpr std::size_t kEach = 10;
  HypothesisWorld world(2 * kEach, rng_);
  Scans all, second;
  for (std::size_t i = 0; i < kEach; ++i) {
    second.push_back(kEach + i);
    if (i + 1 < kEach) {
      for (const std::size_t of : {0ul, kEach})
        world.add(of + i, of + i + 1, {world.hypothesis(of + i, of + i + 1, 9)});
    }
    for (std::size_t j = kEach; j < 2 * kEach; ++j) world.add(i, j, {world.wrong(-1, rng_)});
  }
  for (std::size_t i = 0; i < 2 * kEach; ++i) all.push_back(i);
  world.add(0, kEach, {world.hypothesis(0, kEach, 3)});
  const Cut cut = measure_cut(world.graph(), world.truth(all), second);
  EXPECT_NEAR(cut.support, 3, kOfLogOdds);
  EXPECT_NEAR(cut.lead(), 3 - std::log1p((2 * kEach - 1) * std::exp(-1)), 2 * kOfLogOdds);
}

// Of two other places, by how much the likelier one has.
TEST_F(CutsTest, TheBestOtherPlaceCounts) {
  add(0, 2, 6);
  world_.add(0, 1, {world_.hypothesis(0, 1, 6)});
  world_.add(1, 2, {world_.aside(1, 2, 3, 7), world_.aside(1, 2, 5, -9), world_.aside(1, 2, 4, 20)});
  const Component component = world_.truth({0, 1, 2});
  const Cut cut = measure_cut(world_.graph(), component, {2});
  EXPECT_NEAR(cut.other_support, 5, kOfLogOdds);
  const Isometry3d& T = *component.T_reference_scan[2];
  EXPECT_TRUE(testing::is_pose_near(T * Eigen::Translation3d(0, -9, 0), *cut.other_motion * T, kRounding, kRounding));
  EXPECT_NEAR(cut.lead(), cut.support - std::log(1 + std::exp(3) + std::exp(5) + std::exp(4)), kOfLogOdds);
}

TEST_F(CutsTest, PlacesOfAnySupportAreWeighed) {
  Cut cut;
  cut.support = 2000;
  cut.other_support = 1500;
  cut.other_motion.emplace(Isometry3d::Identity());
  cut.odds_elsewhere = 1e9;
  EXPECT_DOUBLE_EQ(cut.lead(), 500);
  cut.other_motion.reset();
  cut.other_support = 0;
  EXPECT_NEAR(cut.lead(), 2000 - 9 * std::log(10), 1e-8);
}

TEST_F(CutsTest, AGroupThatHangsByOneLinkIsACut) {
  add(0, 1, 7);
  add(0, 2, 7);
  add(1, 2, 7);
  add(2, 3, 4);
  add(3, 4, 7);
  const auto cuts = weakest_cuts(world_.graph(), world_.truth({0, 1, 2, 3, 4}));
  const Cut* group = find(cuts, {3, 4});
  ASSERT_NE(group, nullptr);
  EXPECT_NEAR(group->lead(), 4, kOfLogOdds);
  for (const Cut& cut : cuts) EXPECT_GE(cut.lead(), group->lead() - kRounding) << "no other is held by less";
  for (const std::size_t i : {1u, 2u, 3u, 4u}) EXPECT_NE(find(cuts, {i}), nullptr) << i;
  EXPECT_EQ(find(cuts, {0}), nullptr) << "the reference does not move";
  EXPECT_NEAR(find(cuts, {3})->lead(), 4 + 7 + options_.log_poses, kOfLogOdds) << "alone it would leave 4, too";
}

// Two groups of six, each held by many weak pairs, and to one another by two that are stronger than any of those: no
// tree that takes both has the groups as its parts.
TEST_F(CutsTest, TheWeakestHoldBetweenTwoGroupsIsAmongThem) {
  constexpr std::size_t kEach = 6;
  HypothesisWorld world(2 * kEach, rng_);
  Scans all, second;
  for (std::size_t i = 0; i < 2 * kEach; ++i) {
    all.push_back(i);
    if (i >= kEach) second.push_back(i);
    for (std::size_t j = i + 1; j < (i < kEach ? kEach : 2 * kEach); ++j) {
      world.add(i, j, {world.hypothesis(i, j, 0.5)});
    }
  }
  for (const std::size_t i : {0u, 1u}) world.add(i, kEach + i, {world.hypothesis(i, kEach + i, 1)});
  const PairGraph graph = world.graph();
  const Component component = world.truth(all);
  double least = 1e300;
  for (const Cut& cut : weakest_cuts(graph, component)) least = std::min(least, cut.lead());
  EXPECT_LE(least, measure_cut(graph, component, second).lead() + kRounding);
}

TEST_F(CutsTest, EachPartComesOnceAscendingAndWithoutTheReference) {
  for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(1u, 2u), std::pair(2u, 3u), std::pair(3u, 4u)}) add(a, b, 5);
  const auto cuts = weakest_cuts(world_.graph(), world_.truth({2, 0, 1, 3, 4}));
  std::vector<Scans> parts;
  for (const Cut& cut : cuts) {
    EXPECT_TRUE(std::is_sorted(cut.moved.begin(), cut.moved.end()));
    EXPECT_EQ(std::count(cut.moved.begin(), cut.moved.end(), 2u), 0);
    parts.push_back(cut.moved);
  }
  std::sort(parts.begin(), parts.end());
  EXPECT_EQ(parts, (std::vector<Scans>{{0}, {0, 1}, {1}, {3}, {3, 4}, {4}}));
}

TEST_F(CutsTest, AGroupsTwinTurnedByHalfATurnIsItsOtherMotion) {
  const Isometry3d turned(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
  add(0, 1, 7);
  add(2, 3, 7);
  world_.add(1, 2, {world_.hypothesis(1, 2, 5), world_.hypothesis(1, 2, 4.5, turned)});
  const Component component = world_.truth({0, 1, 2, 3});
  const auto cuts = weakest_cuts(world_.graph(), component);
  const Cut* group = find(cuts, {2, 3});
  ASSERT_NE(group, nullptr);
  EXPECT_NEAR(group->lead(), 5 - with_none(4.5), 2 * kOfLogOdds);
  ASSERT_TRUE(group->other_motion);
  EXPECT_NEAR(rotation_angle_rad(group->other_motion->linear()), std::numbers::pi, 1e-6);
  const Isometry3d& T = *component.T_reference_scan[2];
  EXPECT_TRUE(testing::is_pose_near(T * turned, *group->other_motion * T, kRounding, kRounding));
}

// The twin of a group is told by all links across: one of them may not have it.
TEST_F(CutsTest, LinksAcrossThatDoNotHaveTheTwinSpeakForThePoses) {
  const Isometry3d turned(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
  add(0, 1, 7);
  add(2, 3, 7);
  world_.add(1, 2, {world_.hypothesis(1, 2, 5), world_.hypothesis(1, 2, 5, turned)});
  add(0, 3, 3);
  const Cut cut = measure_cut(world_.graph(), world_.truth({0, 1, 2, 3}), {2, 3});
  EXPECT_NEAR(cut.lead(), 5 + 3 + options_.log_poses - with_none(5), 2 * kOfLogOdds);
}

TEST_F(CutsTest, TheReferenceByItselfCanBeMeasured) {
  add(0, 1, 4);
  add(0, 2, 5);
  add(1, 2, 7);
  const Cut cut = measure_cut(world_.graph(), world_.truth({0, 1, 2}), {0});
  EXPECT_NEAR(cut.lead(), 4 + 5 + options_.log_poses, kOfLogOdds);
}

TEST_F(CutsTest, AScanThatNothingHoldsHasANegativeLead) {
  add(0, 1, 6);
  const Cut cut = measure_cut(world_.graph(), world_.truth({0, 1, 2}), {2});
  EXPECT_EQ(cut.lead(), -options_.log_poses);
  EXPECT_FALSE(cut.other_motion);
}

TEST_F(CutsTest, TheLeadBetweenTwoScansIsOfTheWeakestCutThatPartsThem) {
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {3, 4}}) add(a, b, 8);
  add(1, 3, 4);
  const Leads leads(weakest_cuts(world_.graph(), world_.truth({0, 1, 3, 4})), world_.num_scans());
  EXPECT_NEAR(leads.between(0, 1), 8, kOfLogOdds);
  EXPECT_NEAR(leads.between(4, 3), 8, kOfLogOdds);
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 3}, {4, 1}, {0, 4}}) {
    EXPECT_NEAR(leads.between(a, b), 4, kOfLogOdds);
  }
}

TEST_F(CutsTest, TheFrontierAreThoseThatPairsAcrossHold) {
  add(0, 1, 8);
  add(1, 2, 3);
  add(2, 3, 9);
  add(3, 4, 9);
  world_.add(0, 4, {world_.aside(0, 4, 2, 7)});  // leads elsewhere
  const PairGraph graph = world_.graph();
  const Component component = world_.truth({0, 1, 2, 3, 4});
  EXPECT_EQ(frontier(graph, component, measure_cut(graph, component, {2, 3, 4})), Scans{2});
  EXPECT_EQ(frontier(graph, component, measure_cut(graph, component, {4})), Scans{4});
}

TEST_F(CutsTest, WhatNothingHoldsIsAllFrontier) {
  add(0, 1, 8);
  add(2, 3, 9);
  const PairGraph graph = world_.graph();
  const Component component = world_.truth({0, 1, 2, 3});
  EXPECT_EQ(frontier(graph, component, measure_cut(graph, component, {2, 3})), (Scans{2, 3}));
}

TEST_F(CutsTest, OneScanAloneHasNoCuts) {
  add(0, 1, 6);
  EXPECT_TRUE(weakest_cuts(world_.graph(), component_of_one(0, 6)).empty());
}

// Two pairs that one weak link joins, another component, and a scan in none.
TEST_F(CutsTest, WhatNoWeakCutPartsIsOneGroup) {
  add(0, 1, 8);
  add(1, 2, 1);
  add(2, 3, 8);
  const std::vector<Component> components{world_.truth({0, 1, 2, 3}), world_.truth({4})};
  std::vector<std::vector<Cut>> cuts;
  for (const Component& component : components) cuts.push_back(weakest_cuts(world_.graph(), component));
  const auto groups = clear_groups(components, cuts, 6, world_.num_scans());
  ASSERT_EQ(groups.size(), 6u);
  EXPECT_EQ(groups[0], groups[1]);
  EXPECT_EQ(groups[2], groups[3]);
  EXPECT_EQ(std::set<std::size_t>(groups.begin(), groups.end()).size(), 4u) << "5 is in no component, and alone";
  const auto all_clear = clear_groups(components, cuts, 0.5, world_.num_scans());
  for (const std::size_t i : {1u, 2u, 3u}) EXPECT_EQ(all_clear[i], all_clear[0]);
}

}  // namespace
}  // namespace tcm_icp
