#include "merging/fit_to_cloud.hpp"

#include <gtest/gtest.h>

#include "merging/merged_cloud.hpp"
#include "pipeline/prepared_scene.hpp"
#include "support/matchers.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;

struct Fit {
  Isometry3d start, found;
  MergeRecord record;
  double start_error_m, error_m;
};

// Scan 1 of the scene to scan 0.
Fit fit(const PreparedScene& s, double angle_rad, double shift_m, std::uint64_t seed,
        const MergeOptions& options = {}) {
  MergedCloud merged(s.resolutions.coarse_m);
  merged.add(s.scans[0].pyramid.level(0).cloud, Isometry3d::Identity());
  Rng rng = make_stream(seed, "fit_to_cloud_test");
  const Isometry3d truth = s.scene.T_target_source(0, 1);
  const Points& points = s.scene.scans[1].points;
  Fit out;
  out.start = testing::perturbed(truth, points, angle_rad, shift_m, rng);
  const ScanPyramid target = merged.pyramid();
  const auto method = options.paper_tcm ? place_scan_as_printed : fit_to_cloud;
  out.found = method(s.scans[1], target, out.start, options, rng, out.record);
  out.start_error_m = testing::pose_rmse_m(truth, out.start, points);
  out.error_m = testing::pose_rmse_m(truth, out.found, points);
  return out;
}

PreparedScene scene(const testing::SyntheticSceneOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "fit_to_cloud_test scenes");
  return testing::prepared_scene(options, rng);
}

MergeOptions with(Refinement method) {
  MergeOptions options;
  options.refinement.method = method;
  return options;
}

TEST(FitToCloud, FindsThePoseFromOneOffByACoupleOfVoxels) {
  const PreparedScene s = scene({.points_per_scan = 6000, .range_m = 16, .noise_m = 0.02}, 1);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Fit f = fit(s, 0.05, 0.5, seed, with(Refinement::kNone));
    // Below a tenth of the voxel, which is some 0.4 m: noise is 0.02 m, and voxels that straddle an edge are few.
    const double tolerance = 0.1 * s.resolutions.coarse_m;
    ASSERT_GT(f.start_error_m, 10 * tolerance);
    EXPECT_LE(f.error_m, tolerance) << "seed " << seed;
    EXPECT_TRUE(f.record.simplex.usable());
    EXPECT_GT(f.record.simplex.num_iterations, 1);
    EXPECT_GT(f.record.simplex.lp.num_pivots, 0);
    EXPECT_LE(f.record.simplex.lp.relative_duality_gap, 1e-7);
  }
}

TEST(FitToCloud, RefinementRunsAsAskedForAndWorsensNothing) {
  const PreparedScene s = scene({.points_per_scan = 3000, .noise_m = 0.02}, 2);
  for (const Refinement method :
       {Refinement::kNone, Refinement::kDescent, Refinement::kAnnealing, Refinement::kDescentThenAnnealing}) {
    const Fit f = fit(s, 0.05, 0.3, 4, with(method));
    EXPECT_EQ(f.record.descent.has_value(),
              method == Refinement::kDescent || method == Refinement::kDescentThenAnnealing);
    EXPECT_EQ(f.record.annealing.has_value(),
              method == Refinement::kAnnealing || method == Refinement::kDescentThenAnnealing);
    if (f.record.descent) {
      EXPECT_LE(f.record.descent->final_cost, f.record.descent->initial_cost);
    }
    ASSERT_GT(f.start_error_m, s.resolutions.coarse_m / 2);
    EXPECT_LE(f.error_m, 0.2 * s.resolutions.coarse_m);
  }
}

TEST(FitToCloud, TooFewPointsStayWhereTheyAre) {
  PreparedScene s = scene({.points_per_scan = 3000}, 3);
  s.scans[1].fit_sample.points.resize(10);
  s.scans[1].fit_sample.normals.resize(10);
  const Fit f = fit(s, 0.05, 0.3, 5);
  EXPECT_EQ(f.record.simplex.termination, Termination::kTooFewCorrespondences);
  EXPECT_FALSE(f.record.simplex.usable());
  EXPECT_TRUE(testing::is_pose_near(f.start, f.found, 0, 0));
}

TEST(FitToCloud, WhatMeetsNothingStaysWhereItIs) {
  const PreparedScene s = scene({.points_per_scan = 3000}, 3);
  const Fit f = fit(s, 0, 500, 6);
  EXPECT_FALSE(f.record.simplex.usable());
  EXPECT_TRUE(testing::is_pose_near(f.start, f.found, 0, 0));
}

TEST(PlaceScanAsPrinted, TakesEveryUsableSimplexAndRefinesBothWays) {
  const PreparedScene s = scene({.points_per_scan = 3000, .noise_m = 0.02}, 5);
  MergeOptions options = with(Refinement::kDescentThenAnnealing);
  options.paper_tcm = true;
  const Fit f = fit(s, 0.03, 0.3, 7, options);
  EXPECT_TRUE(f.record.simplex.usable());
  EXPECT_TRUE(f.record.accepted);
  EXPECT_FALSE(f.record.reason.empty());
  EXPECT_TRUE(f.record.descent.has_value());
  EXPECT_TRUE(f.record.annealing.has_value());
  EXPECT_TRUE(is_rigid(f.found.matrix(), 1e-9));
}

}  // namespace
}  // namespace tcm_icp
