#include "pipeline/placement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/merged_cloud.hpp"
#include "pipeline/prepared_scene.hpp"
#include "support/matchers.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;

struct Placement {
  Isometry3d truth, start, found;
  MergeRecord record;
  double start_error_m, error_m;
};

Placement place(const PreparedScene& s, double angle_rad, double shift_m, std::uint64_t seed,
                const PipelineOptions& options = {}, const FreeSpaceCheck& free_space = {}) {
  MergedCloud merged(s.resolutions.coarse_m);
  merged.add(s.scans[0].pyramid.level(0).cloud, Isometry3d::Identity());
  Rng rng = make_stream(seed, "placement_test");
  Placement p;
  p.truth = s.scene.T_target_source(0, 1);
  const Points& points = s.scene.scans[1].points;
  p.start = testing::perturbed(p.truth, points, angle_rad, shift_m, rng);
  const ScanPyramid target = merged.pyramid();
  p.found = options.profile == Profile::kPaper
                ? place_scan_as_printed(s.scans[1], target, p.start, options, rng, p.record)
                : place_scan(s.scans[1], target, p.start, options, rng, p.record, free_space);
  p.start_error_m = testing::pose_rmse_m(p.truth, p.start, points);
  p.error_m = testing::pose_rmse_m(p.truth, p.found, points);
  return p;
}

PreparedScene scene(const testing::SyntheticSceneOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "placement_test scenes");
  return testing::prepared_scene(options, rng);
}

TEST(PlaceScan, FindsAndAcceptsThePoseFromARoughGuess) {
  const PreparedScene s = scene({.points_per_scan = 6000, .range_m = 16, .noise_m = 0.02}, 1);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Placement p = place(s, 0.15, 1.0, seed);
    // Below a tenth of the voxel, which is some 0.4 m: noise is 0.02 m, and voxels that straddle an edge are few.
    const double tolerance = 0.1 * s.resolutions.coarse_m;
    ASSERT_GT(p.start_error_m, 10 * tolerance);
    EXPECT_TRUE(p.record.accepted) << p.record.reason;
    EXPECT_LE(p.error_m, tolerance) << "seed " << seed;
    ASSERT_TRUE(p.record.evidence && p.record.descent && p.record.annealing);
    EXPECT_GT(p.record.evidence->consensus(), 0.3);
    EXPECT_FALSE(std::isnan(p.record.evidence->runner_up)) << "other poses were looked for";
    EXPECT_LE(p.record.descent->final_cost, p.record.descent->initial_cost);
    EXPECT_GT(p.record.simplex.lp.num_pivots, 0);
    EXPECT_LE(p.record.simplex.lp.relative_duality_gap, 1e-7);
  }
}

TEST(PlaceScan, APoseThatFreeSpaceVetoesDoesNotPass) {
  const PreparedScene s = scene({.points_per_scan = 6000, .range_m = 16, .noise_m = 0.02}, 1);
  PipelineOptions options;
  options.placement.search_steps = 0;
  const auto seen_through = [](const Isometry3d&) { return FreeSpaceEvidence{1000, 500, 0, 0}; };
  const auto clear = [](const Isometry3d&) { return FreeSpaceEvidence{1000, 0, 0, 0}; };
  ASSERT_TRUE(place(s, 0.02, 0.2, 1, options, clear).record.accepted);
  const Placement vetoed = place(s, 0.02, 0.2, 1, options, seen_through);
  EXPECT_FALSE(vetoed.record.accepted);
  EXPECT_NE(vetoed.record.reason.find("seen through walls"), std::string::npos) << vetoed.record.reason;
}

TEST(PlaceScan, RefinementRunsAsAskedFor) {
  const PreparedScene s = scene({.points_per_scan = 3000, .noise_m = 0.02}, 2);
  for (const Refinement method :
       {Refinement::kNone, Refinement::kDescent, Refinement::kAnnealing, Refinement::kDescentThenAnnealing}) {
    PipelineOptions options;
    options.refinement.method = method;
    const MergeRecord record = place(s, 0.05, 0.3, 4, options).record;
    EXPECT_EQ(record.descent.has_value(),
              method == Refinement::kDescent || method == Refinement::kDescentThenAnnealing);
    EXPECT_EQ(record.annealing.has_value(),
              method == Refinement::kAnnealing || method == Refinement::kDescentThenAnnealing);
  }
}

TEST(PlaceScan, RejectsAScanOfAnotherPlaceAfterSearching) {
  PreparedScene s = scene({.points_per_scan = 4000, .noise_m = 0.02}, 3);
  Rng rng = make_stream(3, "placement_test rubble");
  const auto rubble = testing::synthetic_scene(
      {.shape = testing::SyntheticShape::kRubble, .num_scans = 1, .points_per_scan = 4000, .noise_m = 0.02}, rng);
  s.scans[1] = prepare_scan(testing::sampled(rubble.scans[0], "rubble.ply"), s.resolutions, {}, 42);
  const Placement p = place(s, 0.1, 0.5, 5);
  EXPECT_FALSE(p.record.accepted) << p.record.reason;
  EXPECT_TRUE(p.record.searched);
  EXPECT_FALSE(p.record.reason.empty());
}

TEST(PlaceScan, RejectsAPoseThatParallelPlanesLeaveOpen) {
  const PreparedScene s = scene(
      {.shape = testing::SyntheticShape::kParallelPlanes, .points_per_scan = 4000, .range_m = 8, .noise_m = 0.02}, 4);
  const Placement p = place(s, 0.05, 0.5, 6);
  EXPECT_FALSE(p.record.accepted) << p.record.reason;
  EXPECT_NE(p.record.reason.find("ambiguous"), std::string::npos) << p.record.reason;
}

TEST(PlaceScanAsPrinted, TakesEveryUsableSimplexAndVerifiesNothing) {
  const PreparedScene s = scene({.points_per_scan = 3000, .noise_m = 0.02}, 5);
  PipelineOptions options;
  options.profile = Profile::kPaper;
  const Placement p = place(s, 0.03, 0.3, 7, options);
  EXPECT_EQ(p.record.accepted, p.record.simplex.usable());
  EXPECT_TRUE(p.record.accepted);
  EXPECT_FALSE(p.record.evidence.has_value());
  EXPECT_TRUE(p.record.descent.has_value());
  EXPECT_TRUE(p.record.annealing.has_value());
  EXPECT_TRUE(is_rigid(p.found.matrix(), 1e-9));
}

}  // namespace
}  // namespace tcm_icp
