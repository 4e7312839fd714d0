// The plan is the library's own; the tests reach into its sources for it.
#include "simulation/site_plan.hpp"

#include <gtest/gtest.h>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

/// Slow and obvious: some point of a fine grid lies in both.
bool share_a_grid_point(const Footprint& a, const Footprint& b) {
  constexpr int kSteps = 120;
  const Eigen::Rotation2Dd turn_a(a.heading_rad), back_b(-b.heading_rad);
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d share(2.0 * i / kSteps - 1, 2.0 * j / kSteps - 1);
      const Eigen::Vector2d p = a.centre + turn_a * share.cwiseProduct(a.half_size_m).eval();
      if (((back_b * (p - b.centre)).cwiseAbs().array() <= b.half_size_m.array()).all()) return true;
    }
  }
  return false;
}

TEST(SitePlanTest, OverlapAgreesWithAGridOfPoints) {
  Rng rng = make_stream(5, "test");
  int overlapping = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Footprint f[2];
    for (Footprint& one : f) {
      one.centre.x() = 8 * uniform01(rng);
      one.centre.y() = 8 * uniform01(rng);
      one.heading_rad = 6 * uniform01(rng);
      one.half_size_m.x() = 0.5 + 3 * uniform01(rng);
      one.half_size_m.y() = 0.5 + 1 * uniform01(rng);
    }
    // A grid may miss a corner that barely reaches in: only what is clear is compared.
    Footprint smaller = f[1], larger = f[1];
    smaller.half_size_m.array() -= 0.1;
    larger.half_size_m.array() += 0.1;
    if (share_a_grid_point(f[0], smaller)) {
      EXPECT_TRUE(overlap(f[0], f[1]));
      ++overlapping;
    } else if (!share_a_grid_point(f[0], larger)) {
      EXPECT_FALSE(overlap(f[0], f[1]));
    }
    EXPECT_EQ(overlap(f[0], f[1]), overlap(f[1], f[0]));
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 350);
}

TEST(SitePlanTest, KeepsTheMargin) {
  SitePlan plan;
  plan.take({{0, 0}, 0, {1, 1}});
  EXPECT_TRUE(plan.is_free({{2.5, 0}, 0, {1, 1}}, 0.4));
  EXPECT_FALSE(plan.is_free({{2.5, 0}, 0, {1, 1}}, 0.6));
}

}  // namespace
}  // namespace tcm_icp
