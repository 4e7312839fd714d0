#include "inference/minimum_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "inference/hypothesis_world.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp {
namespace {

using Nodes = std::vector<std::size_t>;

using testing::between;
using testing::kRounding;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double weight_across(const std::vector<WeightedEdge>& edges, const std::vector<bool>& side) {
  double sum = 0;
  for (const WeightedEdge& e : edges) {
    if (side[e.a] != side[e.b]) sum += e.weight;
  }
  return sum;
}

// Of all cuts there are.
double least_cut(const std::vector<WeightedEdge>& edges, std::size_t num_nodes, std::size_t a, std::size_t b) {
  double least = kInfinity;
  for (std::size_t bits = 0; bits < std::size_t{1} << num_nodes; ++bits) {
    std::vector<bool> side(num_nodes);
    for (std::size_t i = 0; i < num_nodes; ++i) side[i] = (bits >> i & 1) != 0;
    if (side[a] != side[b]) least = std::min(least, weight_across(edges, side));
  }
  return least;
}

double least_cut_among(const std::vector<Nodes>& cuts, const std::vector<WeightedEdge>& edges, std::size_t num_nodes,
                       std::size_t a, std::size_t b) {
  double least = kInfinity;
  for (const Nodes& cut : cuts) {
    std::vector<bool> side(num_nodes, false);
    for (const std::size_t i : cut) side[i] = true;
    if (side[a] != side[b]) least = std::min(least, weight_across(edges, side));
  }
  return least;
}

TEST(MinimumCuts, AreAmongThemForAnyTwoNodes) {
  constexpr std::size_t kNodes = 8;
  const Nodes all{0, 1, 2, 3, 4, 5, 6, 7};
  Rng rng = make_stream(1, "minimum_cuts_test");
  for (int graph = 0; graph < 60; ++graph) {
    std::vector<WeightedEdge> edges;
    for (std::size_t a = 0; a < kNodes; ++a) {
      for (std::size_t b = a + 1; b < kNodes; ++b) {
        // From trees to all pairs; some graphs fall apart.
        if (uniform01(rng) < 0.2 + 0.01 * graph) edges.push_back({between(0.1, 9, rng), a, b});
      }
    }
    const auto cuts = minimum_cuts(edges, all, 0);
    ASSERT_EQ(cuts.size(), kNodes - 1);
    for (std::size_t a = 0; a < kNodes; ++a) {
      for (std::size_t b = a + 1; b < kNodes; ++b) {
        EXPECT_NEAR(least_cut_among(cuts, edges, kNodes, a, b), least_cut(edges, kNodes, a, b), kRounding)
            << a << " and " << b << " in graph " << graph;
      }
    }
  }
}

// Flows turn back on longer and longer detours there, and meet far from either end.
TEST(MinimumCuts, AreAmongThemWhereWaysAreLong) {
  constexpr std::size_t kNodes = 14;
  Nodes all(kNodes);
  std::iota(all.begin(), all.end(), std::size_t{0});
  Rng rng = make_stream(2, "minimum_cuts_test");
  for (int graph = 0; graph < 10; ++graph) {
    std::vector<WeightedEdge> ladder;
    for (std::size_t i = 0; i + 2 < kNodes; ++i) ladder.push_back({between(0.1, 9, rng), i, i + 2});
    for (std::size_t i = 0; i < kNodes; i += 2) ladder.push_back({between(0.1, 9, rng), i, i + 1});
    const auto cuts = minimum_cuts(ladder, all, 3);
    for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 13}, {0, 12}, {1, 12}, {4, 13}, {5, 6}}) {
      EXPECT_NEAR(least_cut_among(cuts, ladder, kNodes, a, b), least_cut(ladder, kNodes, a, b), kRounding)
          << a << " and " << b << " in graph " << graph;
    }
  }
}

TEST(MinimumCuts, OfAPathAreItsEdges) {
  const std::vector<WeightedEdge> path{{3, 1, 4}, {2, 4, 6}, {5, 6, 9}};
  auto cuts = minimum_cuts(path, {1, 4, 6, 9}, 4);
  std::sort(cuts.begin(), cuts.end());
  EXPECT_EQ(cuts, (std::vector<Nodes>{{1}, {6, 9}, {9}})) << "each as the side without the root";
}

TEST(MinimumCuts, WhatNoEdgeJoinsIsCutForNothing) {
  const std::vector<WeightedEdge> edges{{3, 0, 1}};
  const auto cuts = minimum_cuts(edges, {0, 1, 2}, 0);
  EXPECT_EQ(least_cut_among(cuts, edges, 3, 0, 1), 3);
  EXPECT_EQ(least_cut_among(cuts, edges, 3, 0, 2), 0);
  EXPECT_EQ(least_cut_among(cuts, edges, 3, 1, 2), 0);
  EXPECT_TRUE(minimum_cuts({}, {5}, 5).empty());
}

}  // namespace
}  // namespace tcm_icp
