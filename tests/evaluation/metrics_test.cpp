#include "tcm_icp/evaluation/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

/// Large turns about several axes: a reversed product would show.
Isometry3d turned_pose(int i) {
  return Translation3d(10 * i, -7 * i, 3) * AngleAxisd(0.9 + i, Vector3d(1, 2, 3).normalized()) *
         AngleAxisd(1.7 * i, Vector3d::UnitX());
}

/// The eight corners of a cube of edge 2 about `centre`.
Points cube(const Vector3d& centre) {
  Points points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(centre + Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  }
  return points;
}

Truth truth_of(int num_scans) {
  Truth truth;
  for (int i = 0; i < num_scans; ++i) truth.scans.push_back({std::to_string(i) + ".ply", turned_pose(i), 0});
  truth.tolerance = {1.0, 0.1};
  return truth;
}

/// The true poses, as seen from another common frame.
std::vector<std::optional<Isometry3d>> exact_estimates(const Truth& truth) {
  const Isometry3d T_other_world = turned_pose(7);
  std::vector<std::optional<Isometry3d>> estimates;
  for (const auto& scan : truth.scans) estimates.push_back(T_other_world * scan.T_world_scan);
  return estimates;
}

TEST(PoseErrorTest, IsZeroForTruePosesInAnyCommonFrame) {
  const Isometry3d T_other_world = turned_pose(5);
  const PoseError error = pose_error(turned_pose(1), turned_pose(2), T_other_world * turned_pose(1),
                                     T_other_world * turned_pose(2), cube({3, 4, 5}));
  EXPECT_LT(error.rotation_deg, 1e-9);
  EXPECT_LT(error.rmse_m, 1e-9);
}

TEST(PoseErrorTest, OfAShiftIsItsLength) {
  const PoseError error = pose_error(turned_pose(1), turned_pose(2), turned_pose(1),
                                     turned_pose(2) * Translation3d(0.3, 0, 0.4), cube({100, 0, 0}));
  EXPECT_NEAR(error.rotation_deg, 0, 1e-9);
  EXPECT_NEAR(error.rmse_m, 0.5, 1e-9);
  EXPECT_NEAR(error.translation_m, 0.5, 1e-9);
}

TEST(PoseErrorTest, TranslationIsThatOfTheFilesOrigin) {
  // A turn about a place 10 m from the origin moves the origin by its chord, 10 m at 60 degrees.
  const Isometry3d about =
      Translation3d(10, 0, 0) * AngleAxisd(60 * kDegree, Vector3d::UnitZ()) * Translation3d(-10, 0, 0);
  const PoseError error =
      pose_error(turned_pose(1), turned_pose(2), turned_pose(1), turned_pose(2) * about, cube({10, 0, 0}));
  EXPECT_NEAR(error.translation_m, 10, 1e-9);
  EXPECT_NEAR(error.rmse_m, std::sqrt(2.0), 1e-9);
}

TEST(PoseErrorTest, OfATurnAboutZMovesEachPointByItsChord) {
  // Corners of the cube lie sqrt(2) from the z axis; 60 degrees make a chord as long as the radius.
  const PoseError error = pose_error(turned_pose(1), turned_pose(2), turned_pose(1),
                                     turned_pose(2) * AngleAxisd(60 * kDegree, Vector3d::UnitZ()), cube({0, 0, 9}));
  EXPECT_NEAR(error.rotation_deg, 60, 1e-9);
  EXPECT_NEAR(error.rmse_m, std::sqrt(2.0), 1e-9);
}

TEST(PoseErrorTest, HalfATurnKeepsItsPrecision) {
  const PoseError error = pose_error(turned_pose(1), turned_pose(2), turned_pose(1),
                                     turned_pose(2) * AngleAxisd(180 * kDegree, Vector3d::UnitY()), cube({0, 0, 0}));
  EXPECT_NEAR(error.rotation_deg, 180, 1e-6);
}

TEST(PoseErrorTest, HasNoRmseWithoutPoints) {
  const PoseError error = pose_error(turned_pose(1), turned_pose(2), turned_pose(1), turned_pose(2), {});
  EXPECT_TRUE(std::isnan(error.rmse_m));
  EXPECT_FALSE(error.within({1, 1}));
}

TEST(ScorePoses, TellsOkFlaggedAndWrongApart) {
  const Truth truth = truth_of(4);
  auto estimates = exact_estimates(truth);
  estimates[1] = std::nullopt;
  estimates[2] = *estimates[2] * Translation3d(0.11, 0, 0);                                   // 0.1 m are allowed
  estimates[3] = *estimates[3] * AngleAxisd(0.99 * kDegree, Vector3d(1, 1, 0).normalized());  // 1 degree is
  const std::vector<Points> points(4, cube({0, 0, 0}));
  const SceneScore score = score_poses(truth, estimates, 0, points, {});
  EXPECT_EQ(score.scans[0].verdict, PoseVerdict::kOk);
  EXPECT_EQ(score.scans[1].verdict, PoseVerdict::kFlagged);
  EXPECT_FALSE(score.scans[1].error);
  EXPECT_EQ(score.scans[2].verdict, PoseVerdict::kWrong);
  EXPECT_EQ(score.scans[3].verdict, PoseVerdict::kOk);
  EXPECT_EQ(score.count(PoseVerdict::kOk), 2u);
  EXPECT_EQ(score.count(PoseVerdict::kFlagged), 1u);
  EXPECT_EQ(score.count(PoseVerdict::kWrong), 1u);
  ASSERT_TRUE(score.median && score.max_rmse_m);
  EXPECT_NEAR(score.median->rotation_deg, 0.99 / 2, 1e-9);
  EXPECT_NEAR(*score.max_rmse_m, 0.11, 1e-9);
}

TEST(ScorePoses, ATurnBeyondToleranceIsWrongWhereThePointsHardlyMove) {
  const Truth truth = truth_of(2);
  auto estimates = exact_estimates(truth);
  estimates[1] = *estimates[1] * AngleAxisd(1.01 * kDegree, Vector3d::UnitX());
  const SceneScore score = score_poses(truth, estimates, 0, std::vector<Points>(2, cube({0, 0, 0})), {});
  ASSERT_LT(score.scans[1].error->rmse_m, truth.tolerance.rmse_m);
  EXPECT_EQ(score.scans[1].verdict, PoseVerdict::kWrong);
}

TEST(ScorePoses, CountsPairsThatOverlapInOneDirectionAtLeast) {
  Truth truth = truth_of(3);
  truth.overlap.resize(3, 3);
  truth.overlap << 1, 0.05, 0.3,  //
      0.12, 1, 0.02,              //
      0.01, 0.09, 1;
  auto estimates = exact_estimates(truth);
  const std::vector<Points> points(3, cube({0, 0, 0}));
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {}).num_pairs, 2u);  // 0-1 and 0-2
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {0.2}).num_pairs, 1u);
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {}).num_pairs_ok, 2u);
  estimates[2] = *estimates[2] * Translation3d(1, 0, 0);
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {}).num_pairs_ok, 1u);
  estimates[1] = std::nullopt;
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {}).num_pairs_ok, 0u);
}

TEST(ScorePoses, TellsEachPairAndTheirRecall) {
  Truth truth = truth_of(3);
  truth.overlap = Eigen::MatrixXd::Constant(3, 3, 0.4);
  truth.overlap(1, 0) = 0.6;
  auto estimates = exact_estimates(truth);
  estimates[2] = *estimates[2] * Translation3d(1, 0, 0);
  const SceneScore score = score_poses(truth, estimates, 2, std::vector<Points>(3, cube({0, 0, 0})), {});
  ASSERT_EQ(score.pairs.size(), 3u);
  EXPECT_TRUE(score.pairs[0].is_ok);  // 0 and 1 agree, whatever the reference
  EXPECT_EQ(score.pairs[0].overlap, 0.6);
  EXPECT_FALSE(score.pairs[1].is_ok);
  EXPECT_NEAR(score.pairs[1].error->rmse_m, 1, 1e-9);
  EXPECT_NEAR(score.recall(), 1.0 / 3, 1e-12);
  estimates[0] = std::nullopt;
  EXPECT_FALSE(score_poses(truth, estimates, 2, std::vector<Points>(3, cube({0, 0, 0})), {}).pairs[0].error);
  truth.scans.resize(1);
  estimates = exact_estimates(truth);
  EXPECT_TRUE(std::isnan(score_poses(truth, estimates, 0, {cube({0, 0, 0})}, {}).recall()));
}

TEST(ScorePoses, AScanOfAnotherGroupIsOkOnlyWhenLeftOut) {
  Truth truth = truth_of(3);
  truth.scans[2].group = 1;
  auto estimates = exact_estimates(truth);
  const std::vector<Points> points(3, cube({0, 0, 0}));
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {}).scans[2].verdict, PoseVerdict::kWrong);
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {}).num_pairs, 1u);
  estimates[2] = std::nullopt;
  EXPECT_EQ(score_poses(truth, estimates, 0, points, {}).scans[2].verdict, PoseVerdict::kOk);
}

TEST(ScorePoses, RefusesAReferenceWithoutAPoseAndListsThatDiffer) {
  const Truth truth = truth_of(2);
  auto estimates = exact_estimates(truth);
  const std::vector<Points> points(2, cube({0, 0, 0}));
  EXPECT_THROW(score_poses(truth, estimates, 2, points, {}), InvalidInput);
  EXPECT_THROW(score_poses(truth, estimates, 0, {}, {}), InvalidInput);
  EXPECT_THROW(score_poses(truth, estimates, 0, points, {1.5}), InvalidOptions);
  estimates[0] = std::nullopt;
  EXPECT_THROW(score_poses(truth, estimates, 0, points, {}), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
