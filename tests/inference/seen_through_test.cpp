#include "inference/seen_through.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inference/cuts.hpp"
#include "inference/hypothesis_world.hpp"

namespace tcm_icp {
namespace {

using testing::HypothesisWorld;

constexpr std::size_t kPoints = 2000;

using Scans = std::vector<std::size_t>;

// Three storeys of three scans, laid on one another: all pairs agree, and were measured there.
class SeenThroughTest : public ::testing::Test {
 protected:
  static std::size_t storey(std::size_t scan) { return scan / 3; }

  static LookedAt seen(double share, std::size_t points) {
    const auto violations = static_cast<std::size_t>(std::lround(share * static_cast<double>(points)));
    return {points, violations, violations};
  }
  // Of either's points the other looks at as many, and sees through as large a share.
  void add(std::size_t a, std::size_t b, double share, std::size_t points = kPoints, double log_odds = 0.5) {
    add_ways(a, b, seen(share, points), seen(share, points), 1, log_odds);
  }
  void add_ways(std::size_t a, std::size_t b, const LookedAt& of_a, const LookedAt& of_b, double overlap = 1,
                double log_odds = 0.5) {
    PoseHypothesis there = world_.hypothesis(a, b, log_odds);
    there.implied = there.is_there = true;
    there.overlap = overlap;
    there.of_a = of_a;
    there.of_b = of_b;
    world_.add(a, b, {there});
  }
  void add_storeys(double within, double across, std::size_t points = kPoints) {
    for (std::size_t a = 0; a < 9; ++a) {
      for (std::size_t b = a + 1; b < 9; ++b) add(a, b, storey(a) == storey(b) ? within : across, points);
    }
  }
  double excess(std::size_t a, std::size_t b) const { return SeenThrough(world_.graph(), whole()).excess(a, b); }
  std::vector<std::vector<std::size_t>> parts() const { return SeenThrough(world_.graph(), whole()).parts(); }
  Component whole() const { return world_.truth({0, 1, 2, 3, 4, 5, 6, 7, 8}); }

  Rng rng_ = make_stream(1, "seen_through_test");
  HypothesisWorld world_{9, rng_};
};

TEST_F(SeenThroughTest, AStoreySeesThroughTheOthersMoreThanThroughItself) {
  add_storeys(0.01, 0.05);
  const Scans one{3, 4, 5}, other{6, 7, 8}, both{3, 4, 5, 6, 7, 8};
  EXPECT_EQ(parts(), (std::vector<Scans>{both, one, other})) << "the reference stays";
  // Three scans each; 120 points violate within, 900 of either storey's across.
  EXPECT_NEAR(excess(3, 6), std::log(5) - std::sqrt(0.16 * 2 / 3.0 + 1 / 120.0 + 1 / 900.0), 1e-12);
  EXPECT_EQ(excess(7, 4), excess(3, 6));
  EXPECT_EQ(excess(3, 4), 0) << "of one storey";
}

// Masts far away: what may stand between two rays.
TEST_F(SeenThroughTest, WhatIsSmallMakesNoTwins) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) {
      LookedAt looked = seen(storey(a) == storey(b) ? 0.002 : 0.03, kPoints);
      looked.large = 0;
      add_ways(a, b, looked, looked);
    }
  }
  EXPECT_TRUE(parts().empty());
  EXPECT_EQ(excess(3, 6), 0);
}

TEST_F(SeenThroughTest, WhatRightPosesShowIsNoExcess) {
  add_storeys(0.0001, 0.002);
  EXPECT_TRUE(parts().empty());
  EXPECT_EQ(excess(3, 6), 0);
}

TEST_F(SeenThroughTest, OnePairProvesLittle) {
  for (const double share : {0.01, 0.02}) add(0, share > 0.01 ? 2 : 1, share);
  EXPECT_TRUE(parts().empty()) << "twice as much";
}

TEST_F(SeenThroughTest, ASceneWherePeopleWalkHasNone) {
  add_storeys(0.03, 0.03);
  EXPECT_TRUE(parts().empty());
}

TEST_F(SeenThroughTest, AScanTheOthersSeeThroughTwiceAsMuchHasNone) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) add(a, b, a == 4 || b == 4 ? 0.02 : 0.01);
  }
  EXPECT_TRUE(parts().empty());
  EXPECT_EQ(excess(0, 4), 0);
}

// All see through the people, who see through nobody.
TEST_F(SeenThroughTest, ScansWithPeopleAboutThemHaveNone) {
  for (const Scans& with_people : {Scans{4}, Scans{3, 4, 5}, Scans{1, 4, 6}}) {
    world_ = HypothesisWorld(9, rng_);
    const auto share = [&](std::size_t scan) {
      return std::find(with_people.begin(), with_people.end(), scan) == with_people.end() ? 0.002 : 0.05;
    };
    for (std::size_t a = 0; a < 9; ++a) {
      for (std::size_t b = a + 1; b < 9; ++b) add_ways(a, b, seen(share(a), kPoints), seen(share(b), kPoints));
    }
    EXPECT_TRUE(parts().empty());
    EXPECT_EQ(excess(0, 4), 0);
  }
}

TEST_F(SeenThroughTest, WhatOneAloneLooksAtSaysNothing) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) add_ways(a, b, seen(storey(a) == storey(b) ? 0 : 0.05, kPoints), {});
  }
  EXPECT_TRUE(parts().empty());
}

// Along a street with people everywhere neighbours see them, scans two apart see none: every other scan is no part.
TEST_F(SeenThroughTest, WhatOverlapsLittleMakesNoParts) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9 && b < a + 3; ++b) {
      const LookedAt looked = b == a + 1 ? seen(0.015, kPoints) : seen(0, 600);
      add_ways(a, b, looked, looked, b == a + 1 ? 0.6 : 0.15);
    }
  }
  EXPECT_TRUE(parts().empty());
}

TEST_F(SeenThroughTest, FewPointsSayNothing) {
  add_storeys(0.01, 0.05, 20);
  EXPECT_TRUE(parts().empty());
  EXPECT_EQ(excess(3, 6), 0);
}

TEST_F(SeenThroughTest, OnlyPairsMeasuredAtThesePosesTell) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) world_.add(a, b, {world_.hypothesis(a, b, 1)});
  }
  EXPECT_TRUE(parts().empty()) << "found by searches";
  add_storeys(0.01, 0.05);
  EXPECT_FALSE(parts().empty());
  Component moved = whole();
  for (const std::size_t i : {3u, 4u, 5u}) {
    moved.T_reference_scan[i] = Eigen::Translation3d(0, 5, 0) * *moved.T_reference_scan[i];
  }
  EXPECT_EQ(SeenThrough(world_.graph(), moved).excess(0, 3), 0) << "nothing is known of this place";
  EXPECT_GT(SeenThrough(world_.graph(), moved).excess(0, 6), kTwinExcess);
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
  const auto found = parts();
  EXPECT_NE(std::count(found.begin(), found.end(), Scans{3, 4, 5}), 0);
}

// A corridor with one part the wrong way about: what the others see through of it says nothing against the others.
TEST_F(SeenThroughTest, APartThatLiesWrongSaysNothingOfTheRest) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) add(a, b, (storey(a) == 2) == (storey(b) == 2) ? 0.003 : 0.3);
  }
  EXPECT_EQ(parts(), (std::vector<Scans>{{6, 7, 8}, {6, 7, 8}})) << "and what is not of the part with the reference";
  EXPECT_EQ(excess(0, 3), 0);
  EXPECT_GT(excess(0, 6), kTwinExcess);
}

// Whatever is joined when: parts that are joined have a usual excess, and of parts that are not it is more.
TEST_F(SeenThroughTest, NoTwoPartsThatMayBeJoinedAreLeft) {
  for (int trial = 0; trial < 30; ++trial) {
    world_ = HypothesisWorld(9, rng_);
    for (std::size_t a = 0; a < 9; ++a) {
      for (std::size_t b = a + 1; b < 9; ++b) {
        if (uniform01(rng_) < 0.7) add(a, b, 0.002 * std::exp(testing::between(0, 3, rng_)));
      }
    }
    const SeenThrough seen_through(world_.graph(), whole());
    for (std::size_t a = 0; a < 9; ++a) {
      for (std::size_t b = 0; b < 9; ++b) {
        const double excess = seen_through.excess(a, b);
        EXPECT_TRUE(excess == 0 || excess >= kUsualExcess) << excess;
        EXPECT_EQ(excess, seen_through.excess(b, a));
      }
    }
  }
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

// Between right halves of a set in which things were moved between two days, but not many.
TEST_F(SeenThroughTest, PairsThatAreSureHoldWhereLittleIsSeenThrough) {
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a + 1; b < 9; ++b) add(a, b, storey(a) == storey(b) ? 0.005 : 0.012, kPoints, 5);
  }
  EXPECT_GT(measure_cut(world_.graph(), whole(), {3, 4, 5}).lead(), 6);
}

}  // namespace
}  // namespace tcm_icp
