// Joint adjustment against merging alone.

#include <gtest/gtest.h>

#include <algorithm>

#include "adjustment/adjustment.hpp"
#include "merging/merging.hpp"
#include "pipeline/prepared_scene.hpp"

namespace tcm_icp {
namespace {

// Each scan meets the next, and the last the first; hypotheses join all but these two.
TEST(AdjustPoses, CloseALoopBetterThanMergingAlone) {
  double merged_m = 0, adjusted_m = 0;
  // One loop may fall either way by chance; three together hardly.
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng = make_stream(seed, "loop_test");
    const auto s = testing::prepared_scene({.shape = testing::SyntheticShape::kRubble,
                                            .num_scans = 6,
                                            .points_per_scan = 2000,
                                            .range_m = 7,
                                            .noise_m = 0.03},
                                           rng);
    std::vector<PointMoments> moments;
    for (const auto& scan : s.scans) moments.push_back(scan.moments);
    std::vector<ComparedPair> pairs;
    Component component = component_of_one(0, 6);
    for (std::size_t i = 1; i < 6; ++i) {
      component.T_reference_scan[i] =
          testing::perturbed(s.scene.T_target_source(0, i), s.scene.scans[i].points, 0.02, 0.2, rng);
      pairs.push_back({i - 1, i, {{s.scene.T_target_source(i - 1, i), 6}}});
    }
    const auto worst_error_m = [&](const std::vector<Eigen::Isometry3d>& T) {
      double worst = 0;
      for (std::size_t i = 1; i < 6; ++i) {
        worst = std::max(worst, testing::pose_rmse_m(s.scene.T_target_source(0, i), T[i], s.scene.scans[i].points));
      }
      return worst;
    };
    const PairGraph graph(pairs, moments, 4 * s.resolutions.coarse_m, {});
    merge_in_tcm_order(s.scans, graph, {}, {}, component);
    std::vector<Eigen::Isometry3d> T;
    for (const auto& pose : component.T_reference_scan) T.push_back(*pose);
    merged_m += worst_error_m(T);
    const ScanPairs overlapping = overlapping_pairs(s.scans, T, std::vector<bool>(6, true), 0.1, 1);
    ASSERT_TRUE(std::find(overlapping.begin(), overlapping.end(), std::pair<std::size_t, std::size_t>(0, 5)) !=
                overlapping.end());
    adjust_poses(s.scans, overlapping, 0, s.resolutions, {}, {}, {}, T);
    adjusted_m += worst_error_m(T);
  }
  EXPECT_LT(adjusted_m, 0.7 * merged_m);
}

}  // namespace
}  // namespace tcm_icp
