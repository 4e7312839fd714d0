// Components of a run in the survey frame.

#include <gtest/gtest.h>

#include "pipeline/scene_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using test::TempFolder;
using testing::SceneFiles;

const Eigen::Translation3d kUtm(500000, 5000000, 100);
// Two groups are found (pipeline_test.cpp: with 37 of 40 seeds).
constexpr std::uint64_t kSeed = 1;

// Two pairs of scans of two places that share nothing, 60 m apart in the survey frame.
struct TwoPlaces {
  explicit TwoPlaces(const TempFolder& folder) {
    const testing::SyntheticSceneOptions four{.shape = testing::SyntheticShape::kRubble,
                                              .num_scans = 4,
                                              .points_per_scan = 6000,
                                              .range_m = 16,
                                              .noise_m = 0.01};
    files = testing::write_scene(folder.path(), four, 0.12, 1.0, kSeed);
    files.initial.assign(4, std::nullopt);
    Rng rng = make_stream(kSeed, "pipeline_test");
    const auto other = testing::synthetic_scene(four, rng);
    for (const std::size_t i : {2U, 3U}) {
      files.replace(i, other.scans[i]);
      files.scene.T_world_scan[i] = Eigen::Translation3d(60, 0, 0) * other.T_world_scan[i];
    }
    options.reference = "0.ply";
  }

  Eigen::Isometry3d pose(std::size_t scan) const { return kUtm * files.scene.T_world_scan[scan]; }

  // Targets of 2 mm that stand about the scan.
  void add_targets(std::size_t scan, int count) {
    const Eigen::Vector3d places[] = {{5, 1, 0}, {-4, 3, 1}, {0, -6, 2}, {2, 2, -3}, {-3, -3, -1}};
    for (int k = 0; k < count; ++k) {
      ControlPoint point;
      point.name = std::to_string(scan) + "-" + std::to_string(k);
      point.scan = std::to_string(scan) + ".ply";
      point.measured = places[k];
      point.given = pose(scan) * places[k];
      point.sigma_given_m.setConstant(0.002);
      survey.points.push_back(point);
    }
  }
  PipelineResult run(int num_threads = 1) const {
    RunContext context;
    context.num_threads = num_threads;
    return Pipeline(options).run(files.paths, files.initial, context, survey);
  }
  double error_m(const PipelineResult& result, std::size_t scan) const {
    return testing::pose_rmse_m(pose(scan), result.poses[scan].T_reference_scan, files.scene.scans[scan].points);
  }

  SceneFiles files;
  PipelineOptions options;
  Survey survey;
};

TEST(SurveyFrame, ControlOfItsOwnBringsAComponentIntoTheFrame) {
  const TempFolder folder;
  TwoPlaces places(folder);
  places.add_targets(0, 5);
  places.add_targets(3, 4);
  const PipelineResult result = places.run();
  ASSERT_TRUE(result.all_registered());
  EXPECT_TRUE(result.survey.has_frame);
  EXPECT_EQ(result.survey.num_rotations, 3);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(places.error_m(result, i), places.files.scene.spacing_m / 4) << i;
    EXPECT_TRUE(result.uncertainty.poses[i].determined);
  }
  for (const std::size_t i : {2U, 3U}) {
    EXPECT_EQ(result.poses[i].component, 1);
    EXPECT_EQ(result.poses[i].verdict, Verdict::kAccepted);
    EXPECT_NE(result.poses[i].reason.find("of its own alone"), std::string::npos);
  }
  for (const auto& point : result.survey.points) EXPECT_EQ(point.status, PointStatus::kUsed) << point.point.name;
}

TEST(SurveyFrame, TooLittleControlLeavesAComponentWhereItWas) {
  const TempFolder folder;
  TwoPlaces places(folder);
  places.add_targets(1, 4);
  places.add_targets(2, 2);
  const PipelineResult result = places.run();
  for (const std::size_t i : {2U, 3U}) {
    EXPECT_EQ(result.poses[i].status, ScanStatus::kUnregistered);
    EXPECT_TRUE(result.poses[i].pose_in_component.has_value());
  }
  EXPECT_EQ(result.survey.points[3].status, PointStatus::kUsed);
  EXPECT_EQ(result.survey.points[4].status, PointStatus::kNotRegistered);
  EXPECT_LT(places.error_m(result, 0), places.files.scene.spacing_m / 4);
}

TEST(SurveyFrame, AnyTargetMeasuredInTheCommonFrameMovesTheSet) {
  const TempFolder folder;
  TwoPlaces places(folder);
  const PipelineResult before = places.run();
  ASSERT_FALSE(before.survey.has_frame);
  places.add_targets(1, 4);
  for (auto& point : places.survey.points) {
    point.measured = before.poses[1].T_reference_scan * point.measured;
    point.scan.clear();
  }
  const PipelineResult after = places.run();
  EXPECT_LT(places.error_m(after, 0), places.files.scene.spacing_m / 4);
  const Eigen::Isometry3d moved = after.poses[0].T_reference_scan * before.poses[1].T_reference_scan;
  EXPECT_LT((moved.translation() - after.poses[1].T_reference_scan.translation()).norm(), 1e-8);  // as one
}

TEST(SurveyFrame, LevelsCountForTheScansThatHaveThem) {
  const TempFolder folder;
  TwoPlaces places(folder);
  const Eigen::Isometry3d upright = kUtm * Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ());
  places.add_targets(1, 2);  // about the line through both the frame turns freely
  for (auto& point : places.survey.points) point.given = upright * point.measured;
  EXPECT_EQ(places.run().survey.num_rotations, 2);
  places.survey.levels = {{"1.ply", 1e-4}};
  const PipelineResult own = places.run();
  EXPECT_EQ(own.survey.num_rotations, 3);
  EXPECT_LT(rotation_angle_rad(own.poses[1].T_reference_scan.linear().transpose() * upright.linear()), 2e-3);
  places.survey.sigma_level_rad = 1e-4;
  places.survey.levels = {{"0.ply", 0}, {"2.ply", 0}, {"3.ply", 0}};  // which do not stand upright
  EXPECT_EQ(places.run().poses[1].T_reference_scan.matrix(), own.poses[1].T_reference_scan.matrix());
  places.survey.levels = {{"7.ply", 1e-4}};
  EXPECT_THROW(places.run(), InvalidOptions);
}

TEST(SurveyFrame, TheNumberOfThreadsChangesNoBit) {
  const TempFolder folder;
  TwoPlaces places(folder);
  places.add_targets(0, 5);
  places.survey.points[1].given.x() += 0.05;
  const PipelineResult one = places.run(1), two = places.run(2);
  EXPECT_EQ(one.survey.points[1].status, PointStatus::kBlunder);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(one.poses[i].T_reference_scan.matrix(), two.poses[i].T_reference_scan.matrix());
  }
  EXPECT_EQ(one.survey.points[0].residual_m, two.survey.points[0].residual_m);
}

TEST(SurveyFrame, RefusesWhatCannotBe) {
  const TempFolder folder;
  TwoPlaces places(folder);
  places.survey.fixed = {"0.ply"};
  EXPECT_THROW(places.run(), InvalidOptions) << "no initial pose";
  places.survey.fixed = {"none.ply"};
  EXPECT_THROW(places.run(), InvalidOptions);
  places.survey.fixed.clear();
  places.survey.priors = {{"0.ply", 1, 1}};
  EXPECT_THROW(places.run(), InvalidOptions) << "no initial pose";
  places.survey.priors.clear();
  places.add_targets(0, 3);
  places.options.profile = Profile::kPaper;
  EXPECT_THROW(places.run(), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
