#include "support/synthetic_scene.hpp"

#include <gtest/gtest.h>

#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp::testing {
namespace {

// Share of b's points within `reach_m` of a point of a.
double share_near(const Cloud& a, const Cloud& b, double reach_m) {
  const NeighborIndex index(a.points);
  std::size_t near = 0;
  for (const auto& p : b.points) near += index.nearest_within(p, reach_m).found() ? 1 : 0;
  return static_cast<double>(near) / static_cast<double>(b.size());
}

double overlap_at_truth(const SyntheticSceneOptions& options) {
  Rng rng = make_stream(1, "synthetic_scene_test");
  const SyntheticScene scene = synthetic_scene(options, rng);
  return share_near(scene.scans[0], transformed(scene.scans[1], scene.T_target_source(0, 1)), 2 * scene.spacing_m);
}

TEST(SyntheticScene, TruePosesLayTheScansOverEachOtherAndRangeSetsTheOverlap) {
  const double wide = overlap_at_truth({.range_m = 14}), narrow = overlap_at_truth({.range_m = 9});
  EXPECT_GT(wide, 0.55);
  EXPECT_LT(narrow, wide - 0.2);
  EXPECT_GT(narrow, 0.2);
}

TEST(SyntheticScene, ExactPointsShareTheirNeighboursPlaneAndNoisyOnesDoNot) {
  for (const double noise_m : {0.0, 0.05}) {
    Rng rng = make_stream(2, "synthetic_scene_test");
    const SyntheticScene scene = synthetic_scene({.noise_m = noise_m}, rng);
    const Cloud& a = scene.scans[0];
    const Cloud b = transformed(scene.scans[1], scene.T_target_source(0, 1));
    const NeighborIndex index(a.points);
    std::size_t on_plane = 0;
    for (const auto& p : b.points) {
      const Neighbor q = index.nearest(p);
      on_plane += std::abs(a.normals[q.index].dot(p - a.points[q.index])) < 1e-9 ? 1u : 0u;
    }
    const double share = static_cast<double>(on_plane) / static_cast<double>(b.size());
    if (noise_m == 0) {
      EXPECT_GT(share, 0.6);
    } else {
      EXPECT_LT(share, 0.01);
    }
  }
}

}  // namespace
}  // namespace tcm_icp::testing
