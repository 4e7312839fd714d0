#include "coarse/compatibility_graph.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <vector>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

constexpr float kApart = 2, kLength = 4, kTurned = 0.2F;  // what a graph is made with

// Half of them hold under one motion, within noise; the others join points anywhere.
MatchedPoints some_matches(Eigen::Index count, Rng& rng) {
  std::uniform_real_distribution<float> place(0, 30), noise(-0.8F, 0.8F), axis(-1, 1);
  const auto point = [&](auto& of) { return Eigen::Vector3f(of(rng), of(rng), of(rng)); };
  const Eigen::Matrix3f R = Eigen::AngleAxisf(0.7F, Eigen::Vector3f(1, 2, 2).normalized()).toRotationMatrix();
  MatchedPoints out;
  for (auto* m : {&out.target, &out.source, &out.target_normal, &out.source_normal}) m->resize(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    out.source.col(k) = point(place);
    out.source_normal.col(k) = point(axis).normalized();
    out.target.col(k) = k % 2 == 0 ? Eigen::Vector3f(R * out.source.col(k) + point(noise)) : point(place);
    out.target_normal.col(k) = k % 2 == 0 ? Eigen::Vector3f(R * out.source_normal.col(k)) : point(axis).normalized();
  }
  return out;
}

bool can_hold_both(const MatchedPoints& m, Eigen::Index i, Eigen::Index j) {
  const float a = (m.target.col(i) - m.target.col(j)).norm(), b = (m.source.col(i) - m.source.col(j)).norm();
  const float turned = std::abs(std::abs(m.target_normal.col(i).dot(m.target_normal.col(j))) -
                                std::abs(m.source_normal.col(i).dot(m.source_normal.col(j))));
  return i != j && std::abs(a - b) < kApart && std::min(a, b) > kLength && turned < kTurned;
}

// Sizes about those of the words that rows are kept in.
TEST(CompatibilityGraph, JoinsWhatOnePairAfterTheOtherIsFoundToHoldTogether) {
  Rng rng = make_stream(1, "compatibility_graph_test");
  for (const Eigen::Index count : {1, 2, 63, 64, 65, 128, 200}) {
    const MatchedPoints matches = some_matches(count, rng);
    const CompatibilityGraph graph(matches, kApart, kLength, kTurned);
    const auto size = static_cast<std::size_t>(count);
    ASSERT_EQ(graph.size(), size);
    std::vector<std::vector<std::size_t>> joined(size);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) {
        const bool expected = can_hold_both(matches, static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        ASSERT_EQ(graph.joined(i, j), expected) << i << " and " << j << " of " << size;
        if (expected) joined[i].push_back(j);
      }
    }
    std::size_t num_joined = 0;
    for (std::size_t i = 0; i < size; ++i) {
      std::vector<std::size_t> visited;
      graph.for_each_neighbor(i, [&](std::size_t j) { visited.push_back(j); });
      ASSERT_EQ(visited, joined[i]);
      num_joined += joined[i].size();
      for (std::size_t j = 0; j < size; ++j) {
        std::vector<std::size_t> common;
        std::set_intersection(joined[i].begin(), joined[i].end(), joined[j].begin(), joined[j].end(),
                              std::back_inserter(common));
        ASSERT_EQ(graph.num_common(i, j), static_cast<int>(common.size()));
      }
    }
    if (count < 60) continue;
    EXPECT_GT(num_joined, size) << "or there is nothing to compare";
  }
}

TEST(CompatibilityGraph, OfNoMatchesIsEmpty) {
  Rng rng = make_stream(2, "compatibility_graph_test");
  EXPECT_EQ(CompatibilityGraph(some_matches(0, rng), kApart, kLength, kTurned).size(), 0u);
}

}  // namespace
}  // namespace tcm_icp
