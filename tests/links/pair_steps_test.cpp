#include "links/pair_steps.hpp"

#include <gtest/gtest.h>

#include "io/temp_files.hpp"
#include "pipeline/prepared_scene.hpp"

namespace tcm_icp {
namespace {

// A fit asks about a pose, or there alone: what is kept of the one is nothing to the other.
TEST(PairSteps, WhatIsKeptOfAFitIsThatOfTheSameQuestion) {
  Rng rng = make_stream(1, "pair_steps_test");
  auto s = testing::prepared_scene({.points_per_scan = 6000, .range_m = 16, .noise_m = 0.02}, rng);
  s.scans[0].digest = "target";
  s.scans[1].digest = "source";
  const test::TempFolder folder;
  const StepStore store(folder.path() / "work");
  const LinkSearchOptions options;
  PoseCandidate start;
  // Six voxels off: within the first distance of a fit that searches, beyond that of one that is told where.
  start.T_target_source = s.scene.T_target_source(0, 1) * Eigen::Translation3d(0, 0, 6 * s.resolutions.coarse_m);
  for (const bool there : {false, true}) {
    start.there = there;
    const auto fresh = fit_candidate(s.scans[0], s.scans[1], start, options);
    for (int again = 0; again < 2; ++again) {
      const auto kept = fit_candidate_once(&store, s.scans[0], s.scans[1], start, options);
      ASSERT_EQ(fresh.has_value(), kept.has_value()) << there;
      if (!fresh) continue;
      EXPECT_EQ(fresh->T_a_b.matrix(), kept->T_a_b.matrix()) << there;
    }
  }
}

}  // namespace
}  // namespace tcm_icp
