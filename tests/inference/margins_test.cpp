#include "inference/margins.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "inference/hypothesis_world.hpp"

namespace tcm_icp {
namespace {

using testing::HypothesisWorld;
using Scans = std::vector<std::size_t>;

// Scans 0 to 4 in a chain, each with those beside it and next but one; 5 to 7 in another; 8 by itself.
class MarginsTest : public ::testing::Test {
 protected:
  MarginsTest() {
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = i + 1; j < std::min<std::size_t>(i + 3, 8); ++j) {
        if (groups_[i] == groups_[j]) add(i, j, j == i + 1 ? 0.6 : 0.3);
      }
    }
  }
  void add(std::size_t a, std::size_t b, double overlap) {
    PoseHypothesis found = world_.hypothesis(a, b, 5);
    found.overlap = overlap;
    world_.add(a, b, {found});
  }
  Scans margins(std::size_t count) const {
    return margins_of_groups(world_.graph(), {world_.truth({0, 1, 2, 3, 4}), world_.truth({5, 6, 7})}, groups_, count);
  }

  Rng rng_ = make_stream(1, "margins_test");
  HypothesisWorld world_{9, rng_};
  Scans groups_{0, 0, 0, 0, 0, 1, 1, 1, 2};
};

TEST_F(MarginsTest, TheEndsOfEachGroupComeBeforeItsMiddle) {
  EXPECT_EQ(margins(5), (Scans{0, 4, 5, 7, 8}));
  EXPECT_EQ(margins(100), (Scans{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(margins(0), Scans{});
}

TEST_F(MarginsTest, EveryGroupHasOneBeforeAnyHasTwoAndTheLargestIsFirst) {
  EXPECT_EQ(margins(1), Scans{0});
  EXPECT_EQ(margins(2), (Scans{0, 5}));
  EXPECT_EQ(margins(3), (Scans{0, 5, 8}));
  EXPECT_EQ(margins(4), (Scans{0, 4, 5, 8}));
}

TEST_F(MarginsTest, WhatAgreesWithThePosesCountsAloneAndWithinAGroup) {
  PoseHypothesis elsewhere = world_.aside(0, 4, 5, 30);
  elsewhere.overlap = 0.9;
  world_.add(0, 4, {elsewhere});
  add(4, 8, 0.9);
  EXPECT_EQ(margins(5), (Scans{0, 4, 5, 7, 8}));
  add(0, 3, 0.9);
  EXPECT_EQ(margins(2), (Scans{4, 5})) << "0 overlaps another as well";
}

}  // namespace
}  // namespace tcm_icp
