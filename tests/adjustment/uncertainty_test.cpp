#include "adjustment/uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adjustment/adjustment.hpp"
#include "pipeline/prepared_scene.hpp"

namespace tcm_icp {
namespace {

struct Measured {
  JointUncertainty uncertainty;
  std::vector<LinkRecord> links;
};

// Three scans at the poses an adjustment leaves them at; the third is in no pair unless asked for.
Measured measured(double noise_m, const ScanPairs& pairs) {
  Rng rng = make_stream(1, "uncertainty_test");
  const auto s =
      testing::prepared_scene({.num_scans = 3, .points_per_scan = 4000, .range_m = 16, .noise_m = noise_m}, rng);
  std::vector<Eigen::Isometry3d> T;
  for (std::size_t i = 0; i < 3; ++i) T.push_back(s.scene.T_target_source(0, i));
  adjust_poses(s.scans, pairs, 0, s.resolutions, {}, {}, {}, T);
  Measured out;
  out.links.resize(pairs.size());
  measure_uncertainty(s.scans, pairs, 0, s.resolutions, T, 1, out.uncertainty, out.links);
  return out;
}

TEST(MeasureUncertainty, GrowsWithTheNoise) {
  const ScanPairs all{{0, 1}, {0, 2}, {1, 2}};
  const Measured quiet = measured(0.005, all), loud = measured(0.05, all);
  ASSERT_EQ(quiet.uncertainty.poses.size(), 3u);
  for (const std::size_t i : {1u, 2u}) {
    ASSERT_TRUE(quiet.uncertainty.poses[i].determined && loud.uncertainty.poses[i].determined) << i;
    EXPECT_GT(loud.uncertainty.poses[i].sigma_position_m().norm(),
              3 * quiet.uncertainty.poses[i].sigma_position_m().norm())
        << i;
    EXPECT_LT(loud.uncertainty.poses[i].sigma_position_m().norm(), 0.05) << "less than one point's";
  }
  EXPECT_TRUE(quiet.uncertainty.poses[0].covariance.isZero()) << "the reference is exact";
  EXPECT_GT(loud.uncertainty.noise_m, 3 * quiet.uncertainty.noise_m);
}

TEST(MeasureUncertainty, EveryLinkHasItsStrength) {
  for (const auto& link : measured(0.01, {{0, 1}, {0, 2}, {1, 2}}).links) {
    ASSERT_TRUE(link.strength);
    EXPECT_GT(link.strength->num_matches, 100u);
    EXPECT_TRUE(std::isfinite(link.strength->axes[0].sigma_m));
    EXPECT_GE(link.strength->axes[0].sigma_m, link.strength->axes[5].sigma_m) << "weakest first";
  }
}

TEST(MeasureUncertainty, AScanWithoutLinksIsNotDetermined) {
  const Measured m = measured(0.01, {{0, 1}});
  EXPECT_TRUE(m.uncertainty.poses[1].determined);
  EXPECT_FALSE(m.uncertainty.poses[2].determined);
  EXPECT_EQ(m.links.size(), 1u);
}

}  // namespace
}  // namespace tcm_icp
