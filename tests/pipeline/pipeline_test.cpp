#include "tcm_icp/pipeline/pipeline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "pipeline/scene_files.hpp"
#include "support/matchers.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using test::TempFolder;
using testing::SceneFiles;
using testing::SyntheticSceneOptions;

// Initial poses are off by 7 degrees and 1 m each, so scans are off by twice that against each other.
constexpr double kAngle = 0.12, kShift = 1.0;
const SyntheticSceneOptions kThreeScans{.num_scans = 3, .points_per_scan = 6000, .range_m = 16, .noise_m = 0.01};

SceneFiles three_scans(const TempFolder& folder, std::uint64_t seed, double factor = 1) {
  return testing::write_scene(folder.path(), kThreeScans, kAngle, kShift, seed, factor);
}

PipelineResult run(const SceneFiles& files, const PipelineOptions& options = {}, const RunContext& context = {}) {
  return Pipeline(options).run(files.paths, files.initial, context);
}

PipelineOptions with_reference(const std::string& file) {
  PipelineOptions options;
  options.reference = file;
  return options;
}

std::string reasons(const PipelineResult& result) {
  std::string text;
  for (const auto& pose : result.poses) text += pose.file + ": " + pose.reason + "\n";
  return text;
}

TEST(Pipeline, RegistersScansFromFilesAndARoughGuess) {
  const TempFolder folder;
  const SceneFiles files = three_scans(folder, 1);
  const PipelineResult result = run(files);
  ASSERT_TRUE(result.all_registered()) << reasons(result);
  const double tolerance = files.scene.spacing_m / 4;  // points of one scan hardly ever meet one of another nearer
  ASSERT_GT(testing::worst_initial_error_m(files, result.reference), 10 * tolerance);
  EXPECT_LE(testing::worst_error_m(files, result), tolerance);
}

TEST(Pipeline, AnswersAreComplete) {
  const TempFolder folder;
  const SceneFiles files = three_scans(folder, 1);
  const PipelineResult result = run(files, with_reference("2.ply"));
  EXPECT_EQ(result.reference, 2u);
  ASSERT_EQ(result.poses.size(), 3u);
  EXPECT_EQ(result.poses[2].status, ScanStatus::kReference);
  EXPECT_TRUE(result.poses[2].T_reference_scan.isApprox(Isometry3d::Identity(), 0));
  EXPECT_EQ(result.poses[0].file, "0.ply");
  EXPECT_EQ(result.scans[1].num_points, kThreeScans.points_per_scan);
  EXPECT_EQ(result.merges.size(), 2u);
  EXPECT_EQ(result.links.size(), 3u);
  EXPECT_GE(result.coarse_voxel_m, result.fine_voxel_m);
  EXPECT_GT(result.fine_voxel_m, 0);
  for (const auto& pose : result.poses) {
    EXPECT_TRUE(is_rigid(pose.T_reference_scan.matrix(), 1e-9));
    EXPECT_FALSE(pose.reason.empty());
  }
  for (const auto& link : result.links) EXPECT_EQ(link.verdict, "accepted") << link.reason;
}

TEST(Pipeline, TwoThreadsGiveTheSameBitsAsOne) {
  const TempFolder folder;
  const SceneFiles files = three_scans(folder, 2);
  RunContext two;
  two.num_threads = 2;
  const PipelineResult a = run(files), b = run(files, {}, two);
  EXPECT_EQ(a.reference, b.reference);
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_TRUE(a.poses[i].T_reference_scan.matrix() == b.poses[i].T_reference_scan.matrix()) << i;
    EXPECT_EQ(a.poses[i].reason, b.poses[i].reason);
  }
}

TEST(Pipeline, AnyOrderOfTheFilesGivesTheSameBits) {
  const TempFolder folder;
  const SceneFiles files = three_scans(folder, 2);
  SceneFiles mixed = files;
  const std::array<std::size_t, 3> place{2, 0, 1};  // of each file in the other list
  for (std::size_t i = 0; i < 3; ++i) {
    mixed.paths[place[i]] = files.paths[i];
    mixed.initial[place[i]] = files.initial[i];
  }
  const PipelineResult a = run(files), b = run(mixed);
  EXPECT_EQ(b.reference, place[a.reference]);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(b.scans[place[i]].file, a.scans[i].file);
    EXPECT_EQ(b.poses[place[i]].file, a.poses[i].file);
    EXPECT_TRUE(b.poses[place[i]].T_reference_scan.matrix() == a.poses[i].T_reference_scan.matrix()) << i;
    EXPECT_EQ(b.graph.degree(place[i]), a.graph.degree(i));
  }
  ASSERT_EQ(b.links.size(), a.links.size());
  for (std::size_t k = 0; k < a.links.size(); ++k) {
    EXPECT_EQ(b.links[k].a, place[a.links[k].a]);
    EXPECT_EQ(b.links[k].b, place[a.links[k].b]);
  }
  ASSERT_EQ(b.merges.size(), a.merges.size());
  for (std::size_t k = 0; k < a.merges.size(); ++k) EXPECT_EQ(b.merges[k].scan, place[a.merges[k].scan]);
}

TEST(Pipeline, UnitsDoNotMatter) {
  const TempFolder folder, thousandfold;
  const SceneFiles files = three_scans(folder, 3);
  const PipelineResult result = run(files);
  std::filesystem::create_directories(folder.path() / "mm");
  const SceneFiles mm = testing::write_scene(folder.path() / "mm", kThreeScans, kAngle, kShift, 3, 1000);
  const PipelineResult in_mm = run(mm);
  ASSERT_TRUE(result.all_registered() && in_mm.all_registered()) << reasons(result) << reasons(in_mm);
  EXPECT_NEAR(in_mm.coarse_voxel_m, 1000 * result.coarse_voxel_m, 1e-6 * in_mm.coarse_voxel_m);
  EXPECT_LE(testing::worst_error_m(mm, in_mm), mm.scene.spacing_m / 2);
  EXPECT_NEAR(testing::worst_error_m(mm, in_mm) / 1000, testing::worst_error_m(files, result), 1e-6);
}

TEST(Pipeline, AUtmOffsetDoesNotMatter) {
  const TempFolder folder;
  const SceneFiles files = three_scans(folder, 4);
  const PipelineResult result = run(files);
  // Scan 1 as another program exports it: in a national grid.
  SceneFiles shifted = files;
  const Isometry3d T_grid_scan(Eigen::Translation3d(500'000, 5'400'000, 300));
  shifted.replace(1, transformed(files.scene.scans[1], T_grid_scan));
  shifted.initial[1] = *files.initial[1] * T_grid_scan.inverse();
  shifted.scene.T_world_scan[1] = files.scene.T_world_scan[1] * T_grid_scan.inverse();
  const PipelineResult far = run(shifted);
  ASSERT_TRUE(result.all_registered() && far.all_registered()) << reasons(result) << reasons(far);
  // Doubles hold 5,400 km to 1 nm; a rotation by 1e-16 there is a nanometre, too.
  EXPECT_LE(std::abs(testing::worst_error_m(shifted, far) - testing::worst_error_m(files, result)),
            kThreeScans.noise_m);
}

TEST(Pipeline, AScanThatSharesNothingIsUnregistered) {
  const TempFolder folder;
  SceneFiles files = three_scans(folder, 5);
  Rng rng = make_stream(5, "pipeline_test");
  SyntheticSceneOptions rubble = kThreeScans;
  rubble.shape = testing::SyntheticShape::kRubble;
  files.replace(1, testing::synthetic_scene(rubble, rng).scans[0]);
  const PipelineResult result = run(files, with_reference("0.ply"));
  EXPECT_EQ(result.poses[1].status, ScanStatus::kUnregistered) << reasons(result);
  EXPECT_NE(result.poses[1].component, result.poses[0].component);
  EXPECT_EQ(result.poses[1].verdict, "rejected");
  EXPECT_EQ(result.poses[2].status, ScanStatus::kRegistered) << reasons(result);
  EXPECT_FALSE(result.all_registered());
  EXPECT_LE(testing::worst_error_m(files, result), files.scene.spacing_m / 2) << "the others are none the worse";
}

// Where a place is its own mirror image (a rectangular room), no measure of points on surfaces can tell; rubble is not.
TEST(Pipeline, AMirroredScanOfAPlaceWithoutSymmetryIsUnregistered) {
  const TempFolder folder;
  SyntheticSceneOptions rubble = kThreeScans;
  rubble.shape = testing::SyntheticShape::kRubble;
  SceneFiles files = testing::write_scene(folder.path(), rubble, kAngle, kShift, 6);
  ASSERT_TRUE(run(files).all_registered());
  Cloud mirrored = files.scene.scans[1];
  for (auto& p : mirrored.points) p.x() = -p.x();
  files.replace(1, mirrored);
  const PipelineResult result = run(files, with_reference("0.ply"));
  EXPECT_EQ(result.poses[1].status, ScanStatus::kUnregistered) << reasons(result);
  EXPECT_EQ(result.poses[2].status, ScanStatus::kRegistered) << reasons(result);
}

TEST(Pipeline, PaperProfileRunsToItsEnd) {
  const TempFolder folder;
  const SceneFiles files = testing::write_scene(folder.path(), kThreeScans, 0.02, 0.2, 7);
  PipelineOptions options;
  options.profile = Profile::kPaper;
  const PipelineResult result = run(files, options);
  ASSERT_EQ(result.merges.size(), 2u);
  for (const auto& merge : result.merges) {
    EXPECT_TRUE(merge.simplex.usable());
    EXPECT_TRUE(merge.descent && merge.annealing);
    EXPECT_FALSE(merge.evidence);
    EXPECT_GE(merge.tcm.tau(), 0);
  }
  EXPECT_TRUE(result.all_registered());
}

TEST(Pipeline, StopsAtAnyStageWhenAsked) {
  const TempFolder folder;
  const SceneFiles files = testing::write_scene(folder.path(), {.num_scans = 2, .points_per_scan = 1500}, 0.02, 0.2, 8);
  for (const std::string stage : {"reading", "preparing", "comparing", "merging", "adjusting", "verifying"}) {
    RunContext context;
    context.on_progress = [&](const Progress& p) { return p.stage == stage ? Continue::kStop : Continue::kYes; };
    EXPECT_THROW(run(files, {}, context), Cancelled) << stage;
  }
}

TEST(Pipeline, RefusesWrongUsageBeforeItReads) {
  const TempFolder folder;
  const SceneFiles files = testing::write_scene(folder.path(), {.num_scans = 2, .points_per_scan = 300}, 0, 0, 9);
  const Pipeline pipeline{PipelineOptions()};
  EXPECT_THROW(pipeline.run({files.paths[0]}, {files.initial[0]}, {}), InvalidOptions) << "one scan";
  EXPECT_THROW(pipeline.run(files.paths, {files.initial[0]}, {}), InvalidOptions) << "one pose for two";
  EXPECT_THROW(pipeline.run({files.paths[0], files.paths[0]}, files.initial, {}), InvalidInput) << "named twice";
  EXPECT_THROW(pipeline.run({files.paths[0], folder.path() / "none.ply"}, files.initial, {}), InputError);
  EXPECT_THROW(run(files, with_reference("none.ply")), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
