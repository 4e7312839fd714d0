#include "report/weak_spots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

using Scans = std::vector<std::size_t>;

TEST(WeakSpots, NamesTheScanThatHangsOnOneLink) {
  const auto spots = weak_spots({0, 1, 2, 7}, {{0, 1, 0.5}, {1, 2, 0.5}, {2, 0, 0.5}, {2, 7, 0.12}});
  ASSERT_EQ(spots.size(), 1U);
  EXPECT_EQ(spots[0].scans, Scans{7});
  EXPECT_EQ(spots[0].links, Scans{3});
  EXPECT_DOUBLE_EQ(spots[0].weight, 0.12);
}

TEST(WeakSpots, PutsTheWeakestOfSeveralFirst) {
  const auto spots = weak_spots({0, 1, 2, 3}, {{0, 1, 0.5}, {1, 2, 0.2}, {2, 3, 0.3}});
  ASSERT_EQ(spots.size(), 3U);
  EXPECT_EQ(spots[0].links, Scans{1});
  EXPECT_EQ(spots[2].links, Scans{0});
}

TEST(WeakSpots, FindsTheLeastCutWhereNoLinkIsAlone) {
  // Two triangles, joined by two slight links.
  const std::vector<WeightedLink> links{{0, 1, 1}, {1, 2, 1}, {2, 0, 1},   {3, 4, 1},
                                        {4, 5, 1}, {5, 3, 1}, {0, 3, 0.2}, {1, 4, 0.3}};
  const auto spots = weak_spots({0, 1, 2, 3, 4, 5}, links);
  ASSERT_EQ(spots.size(), 1U);
  EXPECT_DOUBLE_EQ(spots[0].weight, 0.5);
  EXPECT_EQ(spots[0].links, (Scans{7, 6})) << "the stronger first";
  EXPECT_EQ(spots[0].scans.size(), 3U);
}

// Against all ways to part the scans in two.
TEST(WeakSpots, AgreesWithTryingEveryCut) {
  Rng rng(7);
  for (int trial = 0; trial < 30; ++trial) {
    const std::size_t n = 7;
    Scans nodes;
    std::vector<WeightedLink> links;
    for (std::size_t i = 0; i < n; ++i) {
      nodes.push_back(i);
      links.push_back({i, (i + 1) % n, 0.1 + uniform01(rng)});  // a ring: no bridges
      links.push_back({i, (i + 2) % n, 0.1 + uniform01(rng)});
    }
    double least = HUGE_VAL;
    for (unsigned side = 1; side < (1U << (n - 1)); ++side) {
      double weight = 0;
      for (const auto& link : links) weight += ((side >> link.a) & 1U) != ((side >> link.b) & 1U) ? link.weight : 0;
      least = std::min(least, weight);
    }
    ASSERT_NEAR(weak_spots(nodes, links).at(0).weight, least, 1e-12);
  }
}

TEST(WeakSpots, SaysNothingOfWhatDoesNotHoldTogether) {
  EXPECT_TRUE(weak_spots({}, {}).empty());
  EXPECT_TRUE(weak_spots({3}, {}).empty());
  EXPECT_TRUE(weak_spots({0, 1, 2}, {{0, 1, 1}}).empty());
  EXPECT_TRUE(weak_spots({0, 1}, {{0, 5, 1}}).empty()) << "links with scans that are not asked for";
}

TEST(WeakSpots, CountsLinksWithoutWeightOnlyWhereNothingElseHolds) {
  const auto bridged = weak_spots({0, 1, 2}, {{0, 1, 1}, {1, 2, 0.4}, {0, 2, 0}});
  ASSERT_EQ(bridged.at(0).links, Scans{1}) << "the link without weight is no second way";
  const auto held = weak_spots({0, 1, 2}, {{0, 1, 1}, {1, 2, 0}});
  EXPECT_EQ(held.at(0).scans, Scans{2});
  EXPECT_EQ(held.at(0).weight, 0);
}

}  // namespace
}  // namespace tcm_icp
