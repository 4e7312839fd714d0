#include "tcm_icp/simulation/scene_set.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

SceneSetOptions coarse() {
  SceneSetOptions options;
  options.num_scans = 3;
  options.scanner.step_deg = 2;
  return options;
}

SceneSet simulate(const SceneSetOptions& options, std::uint64_t seed, int num_threads = 1) {
  RunContext context;
  context.seed = seed;
  context.num_threads = num_threads;
  return simulate_scene_set(options, context);
}

TEST(SceneSetTest, TruthPutsEveryScanOntoTheScenesSurfaces) {
  SceneSetOptions options = coarse();
  options.scanner.isolated_share = 0;
  options.scanner.angular_noise_deg = 0;
  const SceneSet set = simulate(options, 1);
  const RayCaster caster(set.scene.mesh);
  // 5 standard deviations: the largest of a few thousand normal numbers is near 4.
  const double reach_m = 5 * options.scanner.range_noise_m;
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    ASSERT_GT(set.scans[i].cloud.size(), 1000u);
    std::size_t on_surface_untransformed = 0;
    for (const auto& p : set.scans[i].cloud.points) {
      EXPECT_LT(caster.distance_m(set.truth.scans[i].T_world_scan * p), reach_m);
      on_surface_untransformed += caster.distance_m(p) < reach_m ? 1 : 0;
    }
    EXPECT_LT(on_surface_untransformed, set.scans[i].cloud.size() / 10);
  }
}

TEST(SceneSetTest, ScannersStandOnThePathAndFramesAreTurnedTiltedAndShifted) {
  const SceneSetOptions options = coarse();
  const SceneSet set = simulate(options, 2);
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    const auto& T_world_scan = set.truth.scans[i].T_world_scan;
    EXPECT_TRUE(is_rigid(T_world_scan.matrix(), 1e-12));
    const PathPoint middle =
        along_path(set.scene.path, (static_cast<double>(i) + 0.5) / 3 * path_length_m(set.scene.path));
    const Vector3d scanner = T_world_scan * set.scanner_in_scan[i];
    EXPECT_NEAR(scanner.z() - middle.position.z(), 1.8, 1e-9);
    EXPECT_LE((scanner - middle.position).head<2>().norm(), 1.2 + 1e-9);
    EXPECT_LE(set.scanner_in_scan[i].head<2>().norm(), options.max_shift_m);
    EXPECT_GT(set.scanner_in_scan[i].norm(), 1);
    const double tilt_deg = std::acos(T_world_scan.linear()(2, 2)) * 180 / M_PI;
    EXPECT_LE(tilt_deg, options.max_tilt_deg + 0.5);  // and the scanner itself is levelled to half a degree
  }
  const Eigen::Matrix3d between =
      set.truth.scans[0].T_world_scan.linear().transpose() * set.truth.scans[1].T_world_scan.linear();
  EXPECT_GT(rotation_angle_rad(between), 0.1);
}

TEST(SceneSetTest, NeighboursOverlapMoreThanTheEndsDo) {
  const SceneSet set = simulate(coarse(), 3);
  ASSERT_EQ(set.truth.overlap.rows(), 3);
  EXPECT_EQ(set.truth.overlap(1, 1), 1);
  EXPECT_GT(set.truth.overlap(0, 1), 0.1);
  EXPECT_GT(set.truth.overlap(0, 1), set.truth.overlap(0, 2));
}

TEST(SceneSetTest, InitialGuessesAreOffByWhatWasAskedForAndTheFirstIsExact) {
  SceneSetOptions options = coarse();
  options.initial_guess = PosePerturbation{5, 0.5};
  const SceneSet set = simulate(options, 4);
  ASSERT_EQ(set.initial_guess.size(), 3u);
  EXPECT_EQ(set.initial_guess[0].matrix(), set.truth.scans[0].T_world_scan.matrix());
  for (std::size_t i = 1; i < 3; ++i) {
    const Eigen::Isometry3d E = set.initial_guess[i] * set.truth.scans[i].T_world_scan.inverse();
    const double angle_deg = rotation_angle_rad(E.linear()) * 180 / M_PI;
    EXPECT_GE(angle_deg, 3 - 1e-9);
    EXPECT_LE(angle_deg, 5 + 1e-9);
    Vector3d centre = Vector3d::Zero();
    for (const auto& p : set.scans[i].cloud.points) centre += set.truth.scans[i].T_world_scan * p;
    centre /= static_cast<double>(set.scans[i].cloud.size());
    const double shift_m = (E * centre - centre).norm();
    EXPECT_GE(shift_m, 0.3 - 1e-9);
    EXPECT_LE(shift_m, 0.5 + 1e-9);
  }
}

TEST(SceneSetTest, AnInitialGuessLeavesTheScansAsTheyWere) {
  SceneSetOptions options = coarse();
  const SceneSet without = simulate(options, 4);
  options.initial_guess = PosePerturbation{};
  const SceneSet with = simulate(options, 4);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(with.scans[i].cloud.points, without.scans[i].cloud.points);
}

class SceneSetFiles : public ::testing::Test {
 protected:
  SceneSetFiles() { fs::create_directories(folder_); }
  ~SceneSetFiles() override { fs::remove_all(folder_); }

  /// The bytes of all files that a set is written to.
  std::vector<std::string> written(const SceneSet& set) {
    write_scene_set(set, folder_);
    std::vector<fs::path> paths(fs::directory_iterator(folder_), fs::directory_iterator{});
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> contents;
    for (const auto& path : paths) {
      std::ifstream in(path, std::ios::binary);
      contents.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return contents;
  }

  fs::path folder_ = fs::temp_directory_path() / ("tcm_icp_scenes_" + std::to_string(getpid()) +
                                                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(SceneSetFiles, AreTheSameBytesForTheSameSeedAndAnyNumberOfThreads) {
  SceneSetOptions options = coarse();
  options.initial_guess = PosePerturbation{};
  const auto first = written(simulate(options, 7, 1));
  ASSERT_EQ(first.size(), 5u);  // three scans, truth, initial poses
  EXPECT_EQ(written(simulate(options, 7, 4)), first);
  EXPECT_NE(written(simulate(options, 8, 1)), first);
}

TEST_F(SceneSetFiles, TruthComesBackAsItWasToTheLastBit) {
  const SceneSet set = simulate(coarse(), 9);
  write_scene_set(set, folder_);
  const Truth truth = read_truth(folder_ / "truth.json");
  ASSERT_EQ(truth.scans.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(truth.scans[i].file, set.truth.scans[i].file);
    EXPECT_EQ(truth.scans[i].T_world_scan.matrix(), set.truth.scans[i].T_world_scan.matrix());
  }
  EXPECT_EQ(truth.overlap, set.truth.overlap);
  EXPECT_EQ(truth.tolerance.rmse_m, set.truth.tolerance.rmse_m);
}

TEST_F(SceneSetFiles, AreAnOutputErrorWhereTheFolderIsMissing) {
  EXPECT_THROW(write_scene_set(simulate(coarse(), 1), folder_ / "missing"), OutputError);
}

TEST(SceneSetOptionsTest, AreRefusedOutOfBounds) {
  SceneSetOptions options;
  options.num_scans = 0;
  EXPECT_THROW(simulate(options, 1), InvalidOptions);
  options = {};
  options.scanner_height_m = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.initial_guess = PosePerturbation{-1, 0};
  EXPECT_THROW(options.validate(), InvalidOptions);
  EXPECT_THROW(scene_kind_from_name("moon"), InvalidOptions);
  EXPECT_EQ(scene_kind_from_name(scene_name(SceneKind::kTown)), SceneKind::kTown);
}

}  // namespace
}  // namespace tcm_icp
