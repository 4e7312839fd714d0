#include "adjustment/adjustment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "pipeline/prepared_scene.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;

PreparedScene scene(const testing::SyntheticSceneOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "adjustment_test");
  return testing::prepared_scene(options, rng);
}

std::vector<Isometry3d> truth_of(const PreparedScene& s) {
  std::vector<Isometry3d> poses;
  for (std::size_t i = 0; i < s.scans.size(); ++i) poses.push_back(s.scene.T_target_source(0, i));
  return poses;
}

// All but the first, which is the reference.
std::vector<Isometry3d> disturbed(const PreparedScene& s, double angle_rad, double shift_m, std::uint64_t seed) {
  Rng rng = make_stream(seed, "adjustment_test starts");
  std::vector<Isometry3d> poses = truth_of(s);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i] = testing::perturbed(poses[i], s.scene.scans[i].points, angle_rad, shift_m, rng);
  }
  return poses;
}

double worst_error_m(const PreparedScene& s, const std::vector<Isometry3d>& poses) {
  const std::vector<Isometry3d> truth = truth_of(s);
  double worst = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    worst = std::max(worst, testing::pose_rmse_m(truth[i], poses[i], s.scene.scans[i].points));
  }
  return worst;
}

ScanPairs all_pairs(std::size_t n) {
  ScanPairs pairs;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) pairs.emplace_back(a, b);
  }
  return pairs;
}

TEST(OverlappingPairs, AreThoseThatShareEnoughAndArePlaced) {
  const PreparedScene s = scene({.num_scans = 4, .points_per_scan = 2000, .range_m = 6}, 1);
  // Neighbours on the ellipse are 8 m apart, opposite scans 14 and 9 m, with a reach of 6 m.
  const ScanPairs some = overlapping_pairs(s.scans, truth_of(s), {true, true, true, true}, 0.1, 1);
  const std::vector<bool> without_last{true, true, true, false};
  for (const auto& pair : overlapping_pairs(s.scans, truth_of(s), without_last, 0.0, 1)) EXPECT_NE(pair.second, 3u);
  // Those that are not even looked at share nothing.
  const ScanPairs any = overlapping_pairs(s.scans, truth_of(s), {true, true, true, true}, 0.0, 1);
  for (const auto& [a, b] : all_pairs(4)) {
    if (std::find(any.begin(), any.end(), std::pair(a, b)) != any.end()) continue;
    const PyramidLevel &x = s.scans[a].pyramid.level(1), &y = s.scans[b].pyramid.level(1);
    EXPECT_EQ(overlap(x, y, s.scene.T_target_source(a, b), x.voxel_size_m), 0);
  }
  EXPECT_GE(any.size(), some.size());
  EXPECT_TRUE(std::find(some.begin(), some.end(), std::pair<std::size_t, std::size_t>(0, 1)) != some.end());
  EXPECT_TRUE(std::find(some.begin(), some.end(), std::pair<std::size_t, std::size_t>(0, 2)) == some.end());
}

TEST(AdjustPoses, PerturbedTruthComesBack) {
  const PreparedScene s = scene({.num_scans = 4, .points_per_scan = 5000, .range_m = 12}, 2);
  const auto start = disturbed(s, 0.02, 0.1, 2);
  auto poses = start;
  // Exact points; voxels that straddle an edge, and round tubes, leave a hundredth of the voxel at Huber's weight.
  const double tolerance = 0.02 * s.resolutions.fine_m;
  ASSERT_GT(worst_error_m(s, poses), 10 * tolerance);
  const double moved_m = adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, {}, {}, {}, poses).rms_move_m;
  EXPECT_LE(worst_error_m(s, poses), tolerance);
  EXPECT_LE(moved_m, tolerance) << "it has settled";
  EXPECT_TRUE(poses[0].isApprox(start[0], 0)) << "the reference is fixed";
  for (const auto& T : poses) EXPECT_TRUE(is_rigid(T.matrix(), 1e-12));
}

TEST(AdjustPoses, SaysWhatItsProgramsDid) {
  const PreparedScene s = scene({.num_scans = 4, .points_per_scan = 5000, .range_m = 12}, 2);
  auto poses = disturbed(s, 0.02, 0.1, 2);
  AdjustmentOptions options;
  options.steps = 0;
  const AdjustmentRecord record = adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, options, {}, {}, poses);
  EXPECT_EQ(record.lp_status, LpStatus::kOptimal);
  EXPECT_EQ(record.lp.num_programs, 2);
  EXPECT_GT(record.lp.num_pivots, 0);
  EXPECT_LE(record.lp.relative_duality_gap, 1e-7);
  EXPECT_LE(record.num_lp_matches, 12U * 150U);
  EXPECT_GT(record.lp_rms_move_m, 0);
  EXPECT_EQ(record.num_steps, 0);
  // The programs alone bring the scans most of the way.
  EXPECT_LT(worst_error_m(s, poses), 0.3 * worst_error_m(s, disturbed(s, 0.02, 0.1, 2)));
}

// Sets of hundreds of scans: here by the exact solver, which takes few matches.
TEST(AdjustPoses, LeavesProgramsOutWhoseLinksHaveTooFewMatches) {
  const PreparedScene s = scene({.num_scans = 2, .points_per_scan = 2000}, 2);
  const auto start = disturbed(s, 0.02, 0.1, 2);
  AdjustmentOptions options;
  options.steps = 0;
  L1FitOptions exact;
  exact.lp.solver = LpSolver::kCgal;
  auto poses = start;
  const AdjustmentRecord record =
      adjust_poses(s.scans, ScanPairs(101, {0, 1}), 0, s.resolutions, options, exact, {}, poses);
  EXPECT_EQ(record.lp_status, LpStatus::kSizeLimit);
  EXPECT_EQ(record.lp.num_programs, 0);
  EXPECT_TRUE(poses[1].isApprox(start[1], 0));
}

// The start lies beyond the narrow gate, of half a coarse voxel.
TEST(AdjustPoses, WithoutAProgramLeastSquaresBeginWithAWideGate) {
  PreparedScene s = scene({.num_scans = 4, .points_per_scan = 5000, .range_m = 12}, 2);
  const double tolerance = 0.02 * s.resolutions.fine_m;
  s.resolutions.fine_m = s.resolutions.coarse_m / 4;
  const auto start = disturbed(s, 0.05, s.resolutions.coarse_m, 2);
  AdjustmentOptions no_programs;
  no_programs.lp_steps = 0;
  auto poses = start, narrow = start;
  adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, no_programs, {}, {}, poses);
  EXPECT_LE(worst_error_m(s, poses), tolerance);
  adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, no_programs, {}, {}, narrow, StartingPoses::kAdjusted);
  EXPECT_GT(worst_error_m(s, narrow), 10 * tolerance);
}

TEST(AdjustPoses, AdjustedPosesStayWhereTheyAre) {
  const PreparedScene s = scene({.num_scans = 4, .points_per_scan = 5000, .range_m = 12, .noise_m = 0.01}, 4);
  AdjustmentOptions no_programs;
  no_programs.lp_steps = 0;
  no_programs.steps = 40;
  auto poses = disturbed(s, 0.02, 0.1, 4);
  adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, no_programs, {}, {}, poses);
  auto again = poses;
  const AdjustmentRecord record =
      adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, no_programs, {}, {}, again, StartingPoses::kAdjusted);
  EXPECT_LE(record.num_steps, 2);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LE(testing::pose_rmse_m(poses[i], again[i], s.scene.scans[i].points), 0.001);
  }
}

TEST(AdjustPoses, AScanWithoutLinksStays) {
  const PreparedScene s = scene({.num_scans = 3, .points_per_scan = 3000}, 3);
  auto poses = disturbed(s, 0.02, 0.1, 3);
  const auto start = poses;
  adjust_poses(s.scans, {{0, 1}}, 0, s.resolutions, {}, {}, {}, poses);
  EXPECT_FALSE(poses[1].isApprox(start[1], 1e-6));
  EXPECT_TRUE(poses[2].isApprox(start[2], 0));
}

TEST(AdjustPoses, NothingHappensWithoutStepsOrLinks) {
  const PreparedScene s = scene({.num_scans = 2, .points_per_scan = 2000}, 4);
  const auto start = disturbed(s, 0.02, 0.1, 4);
  AdjustmentOptions none;
  none.steps = none.lp_steps = 0;
  auto poses = start;
  EXPECT_EQ(adjust_poses(s.scans, all_pairs(2), 0, s.resolutions, none, {}, {}, poses).rms_move_m, 0);
  EXPECT_TRUE(poses[1].isApprox(start[1], 0));
  EXPECT_EQ(adjust_poses(s.scans, {}, 0, s.resolutions, {}, {}, {}, poses).rms_move_m, 0);
  EXPECT_TRUE(poses[1].isApprox(start[1], 0));
}

TEST(AdjustPoses, ThreadsDoNotChangeABit) {
  const PreparedScene s = scene({.num_scans = 4, .points_per_scan = 2000, .noise_m = 0.02}, 5);
  const auto run = [&](int num_threads) {
    auto poses = disturbed(s, 0.02, 0.1, 5);
    RunContext context;
    context.num_threads = num_threads;
    adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, {}, {}, context, poses);
    return poses;
  };
  const auto one = run(1), two = run(2);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_TRUE(one[i].matrix() == two[i].matrix()) << i;
}

// Each scan as a scanner sees it that spins and moves: a point in direction u lies D u off.
PreparedScene bent_scene(std::uint64_t seed) {
  Rng rng = make_stream(seed, "adjustment_test bends");
  PreparedScene s{testing::synthetic_scene({.num_scans = 4, .points_per_scan = 4000, .noise_m = 0.005}, rng), {}, {}};
  std::vector<SampledScan> scans;
  for (std::size_t i = 0; i < s.scene.scans.size(); ++i) {
    const Eigen::Matrix3d bend_m = Eigen::Matrix3d::NullaryExpr([&] { return 0.1 * standard_normal(rng); });
    Cloud cloud = s.scene.scans[i];
    for (auto& p : cloud.points) p += bend_m * p.normalized();
    scans.push_back(testing::sampled(cloud, std::to_string(i) + ".ply"));
  }
  s.resolutions = choose_resolutions(scans, {}, 1);
  for (const auto& scan : scans) {
    s.scans.push_back(prepare_scan(scan, s.resolutions, {}, 42));
    s.scans.back().sight.swept = true;
    s.scans.back().sight.places = {Eigen::Vector3d::Zero()};
  }
  return s;
}

TEST(AdjustPoses, BendsOfSweptScansAreSolvedForUnlessLeftOut) {
  const PreparedScene s = bent_scene(7);
  const auto run = [&](bool bending, std::vector<Isometry3d>& poses) {
    AdjustmentOptions options;
    options.bending = bending;
    return adjust_poses(s.scans, all_pairs(4), 0, s.resolutions, options, {}, {}, poses);
  };
  auto with = truth_of(s), without = truth_of(s);
  EXPECT_GT(run(true, with).bending_m, 0.02);
  EXPECT_EQ(run(false, without).bending_m, 0);
  EXPECT_LT(worst_error_m(s, with), worst_error_m(s, without));
}

TEST(AdjustPoses, StopsWhenAsked) {
  const PreparedScene s = scene({.num_scans = 2, .points_per_scan = 1000}, 6);
  auto poses = disturbed(s, 0.02, 0.1, 6);
  RunContext context;
  context.on_progress = [](const Progress&) { return Continue::kStop; };
  EXPECT_THROW(adjust_poses(s.scans, all_pairs(2), 0, s.resolutions, {}, {}, context, poses), Cancelled);
}

}  // namespace
}  // namespace tcm_icp
