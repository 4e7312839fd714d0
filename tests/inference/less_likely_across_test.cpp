#include "inference/less_likely_across.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inference/alike_parts.hpp"
#include "inference/hypothesis_world.hpp"

namespace tcm_icp {
namespace {

using testing::HypothesisWorld;

// Three storeys of three scans, laid on one another: all pairs agree, and were measured there.
class LessLikelyAcrossTest : public ::testing::Test {
 protected:
  using Parts = std::vector<std::vector<std::size_t>>;

  static bool of_one_storey(std::size_t a, std::size_t b) { return a / 3 == b / 3; }

  void add(std::size_t a, std::size_t b, double log_odds, double overlap = 0.5) {
    PoseHypothesis there = world_.hypothesis(a, b, log_odds);
    there.implied = there.is_there = true;
    there.overlap = overlap;
    world_.add(a, b, {there});
  }
  template <typename Add>
  void for_pairs(Add add_pair) {
    for (std::size_t a = 0; a < 9; ++a) {
      for (std::size_t b = a + 1; b < 9; ++b) add_pair(a, b);
    }
  }
  void add_storeys(double within, double across) {
    for_pairs([&](std::size_t a, std::size_t b) { add(a, b, of_one_storey(a, b) ? within : across); });
  }
  Component whole() const { return world_.truth({0, 1, 2, 3, 4, 5, 6, 7, 8}); }
  LessLikelyAcross all() const { return LessLikelyAcross(world_.graph(), whole_); }
  double deficit(std::size_t a, std::size_t b) const { return all().deficit(a, b); }
  Parts parts() const { return all().parts(); }

  Rng rng_ = make_stream(1, "less_likely_across_test");
  HypothesisWorld world_{9, rng_};
  Component whole_ = whole();
};

TEST_F(LessLikelyAcrossTest, PairsOfTwoStoreysShowLessThanThoseOfOne) {
  add_storeys(6, 1.5);
  EXPECT_EQ(parts(), (Parts{{3, 4, 5, 6, 7, 8}, {3, 4, 5}, {6, 7, 8}})) << "the reference stays";
  // At half of the points in common 5 is usual: 1 beyond that within, 3.5 less across. Nine of 36 pairs are of one
  // storey, so their upper quartile is 1, too; it stands for one pair beside the six of two storeys.
  EXPECT_NEAR(deficit(3, 6), 1 + 3.5 - std::sqrt(1.5 * 1.5 * 2 / 3 + 2 * 2 * (1 / 9.0 + 1 / 7.0)), 1e-12);
  EXPECT_EQ(deficit(7, 4), deficit(3, 6));
  EXPECT_EQ(deficit(3, 4), 0);
  EXPECT_EQ(all().twins(3, 6), 1);
  EXPECT_EQ(all().twins(3, 4), 0);
}

TEST_F(LessLikelyAcrossTest, WhatAllPairsLackMakesNoParts) {
  add_storeys(1, 1);
  EXPECT_TRUE(parts().empty());
  EXPECT_TRUE(LessLikelyAcross(world_.graph(), world_.truth({0, 1})).parts().empty());
}

// Rooms share a doorway: of what overlaps little right pairs show less.
TEST_F(LessLikelyAcrossTest, PairsThatOverlapLittleMayShowLess) {
  for_pairs([&](std::size_t a, std::size_t b) {
    const bool near = of_one_storey(a, b);
    add(a, b, near ? 6.5 : 2.5, near ? 0.8 : 0.1);
  });
  EXPECT_TRUE(parts().empty());
}

// Floors of a shell, right as they lie, see little of one another; of what they see little agrees.
TEST_F(LessLikelyAcrossTest, WhatDoesNotLieOnOneAnotherIsNoTwin) {
  for_pairs([&](std::size_t a, std::size_t b) {
    const bool near = of_one_storey(a, b);
    add(a, b, near ? 6 : -1, near ? 0.5 : 0.25);
  });
  EXPECT_TRUE(parts().empty());
}

TEST_F(LessLikelyAcrossTest, OneScanWithPeopleAboutItIsNoTwin) {
  for_pairs([&](std::size_t a, std::size_t b) { add(a, b, b == 8 ? 2.5 : 5.5); });
  EXPECT_TRUE(parts().empty());
}

TEST_F(LessLikelyAcrossTest, OnlyPairsMeasuredAtThesePosesTell) {
  for_pairs(
      [&](std::size_t a, std::size_t b) { world_.add(a, b, {world_.hypothesis(a, b, of_one_storey(a, b) ? 6 : 1)}); });
  EXPECT_TRUE(parts().empty()) << "found by searches";
  add_storeys(6, 0);
  EXPECT_FALSE(parts().empty());
  for (const std::size_t i : {3u, 4u, 5u}) {
    whole_.T_reference_scan[i] = Eigen::Translation3d(0, 5, 0) * *whole_.T_reference_scan[i];
  }
  EXPECT_EQ(deficit(0, 3), 0) << "nothing is known of this place";
  EXPECT_GT(deficit(0, 6), 1.25);
}

TEST_F(LessLikelyAcrossTest, NoTwoPartsThatMayBeJoinedAreLeft) {
  std::size_t num_twins = 0;
  for (int trial = 0; trial < 30; ++trial) {
    world_ = HypothesisWorld(9, rng_);
    for_pairs([&](std::size_t a, std::size_t b) {
      if (uniform01(rng_) < 0.7) add(a, b, testing::between(-4, 8, rng_), testing::between(0.1, 1, rng_));
    });
    whole_ = whole();
    const LessLikelyAcross parts = all();
    for (std::size_t a = 0; a < 9; ++a) {
      for (std::size_t b = 0; b < 9; ++b) {
        EXPECT_EQ(parts.deficit(a, b), parts.deficit(b, a));
        EXPECT_TRUE(parts.deficit(a, b) == 0 || parts.deficit(a, b) >= 1.25) << parts.deficit(a, b);
        num_twins += parts.twins(a, b) > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(num_twins, 0U);
}

TEST_F(LessLikelyAcrossTest, AgreementOfTwinsSaysLessWhicheverTellsThem) {
  add_storeys(7, -3);
  const AlikeParts alike(world_.graph(), whole_);
  EXPECT_DOUBLE_EQ(alike.less_said(0, 3), world_.graph().options().log_alike);
  EXPECT_EQ(alike.less_said(0, 1), 0);
  EXPECT_EQ(alike.parts(), parts()) << "nothing is seen through";
}

}  // namespace
}  // namespace tcm_icp
