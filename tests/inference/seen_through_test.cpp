#include "inference/seen_through.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inference/cuts.hpp"
#include "inference/hypothesis_world.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {
namespace {

using testing::HypothesisWorld;

constexpr double kPoints = 2000;

// Three storeys of three scans, laid on one another: all pairs agree, and were measured there.
class SeenThroughTest : public ::testing::Test {
 protected:
  static std::size_t storey(std::size_t scan) { return scan / 3; }

  void add(std::size_t a, std::size_t b, double share, double points = kPoints, double log_odds = 0.5) {
    PoseHypothesis there = world_.hypothesis(a, b, log_odds);
    there.implied = there.is_there = true;
    there.points_seen = points;
    there.points_through = share * points;
    world_.add(a, b, {there});
  }
  void add_storeys(double within, double across, double points = kPoints) {
    for (std::size_t a = 0; a < 9; ++a) {
      for (std::size_t b = a + 1; b < 9; ++b) add(a, b, storey(a) == storey(b) ? within : across, points);
    }
  }
  static std::vector<bool> side_of(const std::vector<std::size_t>& part) {
    std::vector<bool> out(9, false);
    for (const std::size_t i : part) out[i] = true;
    return out;
  }
  double excess(const std::vector<std::size_t>& part) const {
    return SeenThrough(world_.graph(), whole()).excess(side_of(part));
  }
  Component whole() const { return world_.truth({0, 1, 2, 3, 4, 5, 6, 7, 8}); }

  Rng rng_ = make_stream(1, "seen_through_test");
  HypothesisWorld world_{9, rng_};
};

TEST_F(SeenThroughTest, AStoreySeesThroughTheOthersMoreThanThroughItself) {
  add_storeys(0.01, 0.05);
  // Three pairs within, 18 across.
  EXPECT_NEAR(excess({3, 4, 5}), std::log(5) - 0.6 * std::sqrt(1 / 3.0 + 1 / 18.0), 1e-12);
  EXPECT_EQ(excess({0, 1, 2, 6, 7, 8}), excess({3, 4, 5})) << "the other side of the cut";
  EXPECT_LT(excess({2, 3, 4}), kUsualExcess) << "no storey";
}

TEST_F(SeenThroughTest, WhatRightPosesShowIsNoExcess) {
  add_storeys(0.0001, kUsualViolations);
  EXPECT_EQ(excess({3, 4, 5}), 0);
}

TEST_F(SeenThroughTest, OnePairWithinProvesLittle) {
  add_storeys(0.01, 0.02);
  EXPECT_LT(excess({3, 4}), excess({3, 4, 5}) - 0.1);
  EXPECT_LT(excess({3, 4}), kUsualExcess);
}

TEST_F(SeenThroughTest, ASceneWherePeopleWalkHasNone) {
  add_storeys(0.03, 0.03);
  EXPECT_EQ(excess({3, 4, 5}), 0);
  EXPECT_TRUE(SeenThrough(world_.graph(), whole()).parts(kUsualExcess).empty());
}

TEST_F(SeenThroughTest, AScanWithPeopleAboutItHasNone) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) add(a, b, a == 4 || b == 4 ? 0.05 : 0.01);
  }
  EXPECT_EQ(excess({4}), 0);
}

TEST_F(SeenThroughTest, FewPointsSayNothing) {
  add_storeys(0.01, 0.05, 20);
  EXPECT_EQ(excess({3, 4, 5}), 0);
  EXPECT_TRUE(SeenThrough(world_.graph(), whole()).parts(kUsualExcess).empty());
}

TEST_F(SeenThroughTest, OnlyPairsMeasuredAtThesePosesTell) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) world_.add(a, b, {world_.hypothesis(a, b, 1)});
  }
  EXPECT_EQ(excess({3, 4, 5}), 0) << "found by searches";
  add_storeys(0.01, 0.05);
  Component moved = whole();
  for (const std::size_t i : {3u, 4u, 5u}) {
    moved.T_reference_scan[i] = Eigen::Translation3d(0, 5, 0) * *moved.T_reference_scan[i];
  }
  EXPECT_EQ(SeenThrough(world_.graph(), moved).excess(side_of({3, 4, 5})), 0) << "nothing is known of this place";
}

TEST_F(SeenThroughTest, PartsAreTheStoreys) {
  add_storeys(0.002, 0.03);
  const auto parts = SeenThrough(world_.graph(), whole()).parts(kUsualExcess);
  for (const std::vector<std::size_t>& storey : {std::vector<std::size_t>{3, 4, 5}, {6, 7, 8}}) {
    EXPECT_NE(std::count(parts.begin(), parts.end(), storey), 0);
  }
  for (const auto& part : parts) EXPECT_EQ(std::count(part.begin(), part.end(), 0u), 0) << "the reference stays";
}

// Pairs that share a doorway only look at few points, none of which is seen through.
TEST_F(SeenThroughTest, PairsThatSeeLittleJoinNoStoreys) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) {
      const bool sees_little = a % 3 == 0 && b % 3 == 2;
      if (storey(a) == storey(b)) {
        add(a, b, 0.002);
      } else {
        add(a, b, sees_little ? 0 : 0.03, sees_little ? 510 : kPoints);
      }
    }
  }
  const auto parts = SeenThrough(world_.graph(), whole()).parts(kUsualExcess);
  EXPECT_NE(std::count(parts.begin(), parts.end(), std::vector<std::size_t>{3, 4, 5}), 0);
}

// Each pair across says a little for its poses, and there are many of them.
TEST_F(SeenThroughTest, AgreementSaysLessAgainstTwinsThatAreSeenThrough) {
  add_storeys(0.002, 0.002);
  const PairGraph alike = world_.graph();
  const double lead = measure_cut(alike, whole(), {3, 4, 5}).lead();
  EXPECT_GT(lead, 6) << "as nothing speaks against it";
  world_ = HypothesisWorld(9, rng_);
  add_storeys(0.002, 0.03);
  const Cut cut = measure_cut(world_.graph(), whole(), {3, 4, 5});
  EXPECT_LT(cut.lead(), 0);
  const auto cuts = weakest_cuts(world_.graph(), whole(), 1);
  EXPECT_TRUE(std::any_of(cuts.begin(), cuts.end(), [&](const Cut& c) { return c.moved == cut.moved; }));
  InferenceOptions options;
  options.log_alike = 0;
  EXPECT_NEAR(measure_cut(world_.graph(options), whole(), {3, 4, 5}).lead(), lead, testing::kRounding);
}

// Between right halves of a set in which things were moved between two days.
TEST_F(SeenThroughTest, PairsThatAreSureHoldAllTheSame) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) add(a, b, storey(a) == storey(b) ? 0.002 : 0.03, kPoints, 5);
  }
  EXPECT_GT(measure_cut(world_.graph(), whole(), {3, 4, 5}).lead(), 6);
}

}  // namespace
}  // namespace tcm_icp
