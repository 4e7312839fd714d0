#include "tcm_icp/baselines/spanning_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp {
namespace {

PairFit pair(std::size_t source, std::size_t target, double share, double mean_distance_m = 1) {
  PairFit fit;
  fit.source = source;
  fit.target = target;
  fit.share = share;
  fit.mean_distance_m = mean_distance_m;
  return fit;
}

double total_share(const std::vector<PairFit>& pairs, const std::vector<std::size_t>& tree) {
  double sum = 0;
  for (const std::size_t k : tree) sum += pairs[k].share;
  return sum;
}

// Every choice of n - 1 pairs that reaches all scans, tried.
double best_by_trial(std::size_t n, const std::vector<PairFit>& pairs) {
  double best = -1;
  for (unsigned subset = 0; subset < 1U << pairs.size(); ++subset) {
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if ((subset >> k & 1U) != 0) chosen.push_back(k);
    }
    if (chosen.size() + 1 != n) continue;
    const auto poses = poses_along_tree(n, pairs, chosen, 0);
    const bool all = std::all_of(poses.begin(), poses.end(), [](const auto& T) { return T.has_value(); });
    if (all) best = std::max(best, total_share(pairs, chosen));
  }
  return best;
}

TEST(SpanningTree, HasTheLargestSumOfSharesThereIs) {
  Rng rng = make_stream(1, "spanning_tree_test");
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<PairFit> pairs;
    for (std::size_t a = 0; a < 5; ++a) {
      for (std::size_t b = 0; b < a; ++b) pairs.push_back(pair(a, b, uniform01(rng)));
    }
    const auto tree = maximum_spanning_tree(5, pairs);
    ASSERT_EQ(tree.size(), 4U);
    EXPECT_DOUBLE_EQ(total_share(pairs, tree), best_by_trial(5, pairs));
  }
}

TEST(SpanningTree, OfEqualSharesTakesTheLeastDistance) {
  const std::vector<PairFit> pairs{pair(0, 1, 0.5), pair(0, 2, 0.5, 3), pair(1, 2, 0.5, 2)};
  EXPECT_EQ(maximum_spanning_tree(3, pairs), (std::vector<std::size_t>{0, 2}));
}

TEST(SpanningTree, LeavesScansWithoutPairsOut) {
  const std::vector<PairFit> pairs{pair(0, 1, 0.5)};
  const auto tree = maximum_spanning_tree(3, pairs);
  ASSERT_EQ(tree.size(), 1U);
  const auto poses = poses_along_tree(3, pairs, tree, 0);
  EXPECT_TRUE(poses[1].has_value());
  EXPECT_FALSE(poses[2].has_value());
}

TEST(SpanningTree, TheReferenceHasMostPairsOfTheTree) {
  const std::vector<PairFit> pairs{pair(0, 3, 0.5), pair(3, 1, 0.4), pair(2, 3, 0.3), pair(0, 1, 0.2)};
  EXPECT_EQ(tree_reference(4, pairs, maximum_spanning_tree(4, pairs)), 3U);
}

TEST(SpanningTree, PosesFollowPairsInBothDirections) {
  Rng rng = make_stream(2, "spanning_tree_test");
  std::vector<Eigen::Isometry3d> truth;
  for (int i = 0; i < 4; ++i) truth.push_back(testing::random_pose(50, rng));
  // A chain 0 - 1 - 2 - 3 whose pairs point this way and that, the reference in its middle.
  std::vector<PairFit> pairs{pair(0, 1, 0.5), pair(2, 1, 0.5), pair(2, 3, 0.5)};
  for (auto& p : pairs) p.T_target_source = truth[p.target].inverse() * truth[p.source];
  const auto poses = poses_along_tree(4, pairs, {2, 0, 1}, 2);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(poses[i].has_value());
    // Rounding of coordinates of 50 m.
    EXPECT_TRUE(testing::is_pose_near(truth[2].inverse() * truth[i], *poses[i], 1e-9, 1e-9));
  }
}

}  // namespace
}  // namespace tcm_icp
