#include "report/scene.hpp"

#include <gtest/gtest.h>

#include "report/cloud_picture.hpp"
#include "report/section_cut.hpp"

namespace tcm_icp {
namespace {

// Scan 1 lies 5 m in x from scan 0, whose raw coordinates begin at 1000; both see a wall at x = 2 of the common frame.
PipelineResult two_at_a_wall() {
  PipelineResult result;
  result.fine_voxel_m = 0.1;
  result.scans.resize(2);
  result.scans[0].origin = Eigen::Vector3d(1000, 0, 0);
  result.poses.resize(2);
  result.poses[0].status = ScanStatus::kReference;
  result.poses[1].status = ScanStatus::kRegistered;
  result.poses[1].T_reference_scan.translation() = Eigen::Vector3d(1005, 0, 0);
  LinkRecord link;
  link.a = 1;
  link.b = 0;
  link.verdict = Verdict::kAccepted;
  for (int i = 0; i < 40; ++i) {
    link.residuals.matches.push_back({false, 0.002F, Eigen::Vector3f(-3, 0.05F * static_cast<float>(i), 1)});
    link.residuals.matches.push_back({true, -0.002F, Eigen::Vector3f(2, 0.05F * static_cast<float>(i), 1)});
  }
  link.residuals.contact = LinkContact{Eigen::Vector3d(-3, 1, 1), Eigen::Vector3d::UnitX(), 80};
  result.links.push_back(link);
  return result;
}

TEST(Scene, PutsPointsOfBothScansIntoOneFrame) {
  const PipelineResult result = two_at_a_wall();
  const Scene scene = make_scene(result, {{{2, 1, 1}}, {{-3, 1, 1}}}, 2);
  const Eigen::Vector3d of_0 = scene.scans[0].T_view_scan * scene.scans[0].points[0].cast<double>(),
                        of_1 = scene.scans[1].T_view_scan * scene.scans[1].points[0].cast<double>();
  EXPECT_NEAR((of_0 - of_1).norm(), 0, 1e-9);
  EXPECT_LT(of_0.norm(), 5) << "near the origin of the view, which graphics cards need";
  EXPECT_NEAR((of_0 + scene.registered().origin - Eigen::Vector3d(1002, 1, 1)).norm(), 0, 1e-9);
}

TEST(Scene, TellsDistancesWhereAnotherScanIsNear) {
  const Scene scene = make_scene(two_at_a_wall(), {{{2, 1, 1}, {50, 0, 0}}, {{-3, 1, 1}}}, 1);
  EXPECT_NEAR(scene.most_m, 0.2, 1e-12);
  EXPECT_EQ(scene.scans[0].distances[0], 25) << "254 times the root of 2 mm by 200 mm";
  EXPECT_EQ(scene.scans[0].distances[1], Scene::kNoSurface);
  EXPECT_EQ(scene.scans[1].distances[0], 25);
}

// Two scans hold together, but not with the first, and one is left over.
TEST(Scene, KeepsGroupsThatAreNotRegisteredApart) {
  PipelineResult result = two_at_a_wall();
  result.scans.resize(4);
  result.poses.resize(4);
  result.poses[1] = {};
  const Eigen::Vector3d far(500'000, 5'000'000, 0);
  for (const std::size_t i : {2U, 3U}) {
    result.scans[i].origin = far;
    result.poses[i].component = 2;
    result.poses[i].pose_in_component = Eigen::Isometry3d::Identity();
  }
  result.poses[2].pose_in_component->translation().x() = 3;
  result.poses[1].component = 1;
  const Scene scene = make_scene(result, {{{2, 1, 1}}, {}, {{0, 0, 0}}, {{1, 2, 3}}}, 1);
  ASSERT_EQ(scene.groups.size(), 2U) << "a scan by itself is no group";
  EXPECT_EQ(scene.groups[1].component, 2);
  EXPECT_EQ(scene.scans[0].group, 0U);
  EXPECT_EQ(scene.scans[2].group, 1U);
  EXPECT_EQ(scene.scans[3].group, 1U);
  EXPECT_EQ(scene.groups[1].origin, far) << "that of the scan whose frame it is";
  EXPECT_NEAR((scene.scans[2].T_view_scan * Eigen::Vector3d::Zero() - Eigen::Vector3d(3, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((scene.groups[1].box.max() - Eigen::Vector3d(3, 2, 3)).norm(), 0, 1e-6);
  EXPECT_NEAR(scene.registered().box.max().x(), 2, 1e-9) << "the other group does not make it larger";
  EXPECT_EQ(picture_points(scene).size(), 1U);
}

TEST(Scene, IsThereWithoutPointsAndResolutions) {
  PipelineResult result = two_at_a_wall();
  result.fine_voxel_m = 0;  // as in the paper's profile
  const Scene scene = make_scene(result, {{{2, 1, 1}}, {}}, 1);
  EXPECT_EQ(scene.num_points(), 1U);
  EXPECT_EQ(scene.scans[0].distances[0], Scene::kNoSurface);
  EXPECT_EQ(make_scene(result, {{}, {}}, 1).num_points(), 0U);
}

TEST(SectionCut, CutsTheWallWhereTheScansMeet) {
  const PipelineResult result = two_at_a_wall();
  std::vector<SectionCut> cuts = choose_sections(result);
  ASSERT_EQ(cuts.size(), 1U) << "there is no second link";
  EXPECT_TRUE(cuts[0].is_level);
  SectionCutter cutter(cuts, result);
  // Raw coordinates: on the wall, above the section, beside its window, and on the wall from the other scan.
  cutter.add(0, std::vector<Eigen::Vector3d>{{1002, 1, 1}, {1002, 1, 1.5}, {1004, 1, 1}});
  cutter.add(1, std::vector<Eigen::Vector3d>{{-3.01, 1.2, 1.05}});
  ASSERT_EQ(cuts[0].points.size(), 2U);
  EXPECT_EQ(cuts[0].points[0].scan, 0U);
  EXPECT_NEAR(cuts[0].points[0].across, 0, 1e-6);
  EXPECT_EQ(cuts[0].points[1].scan, 1U);
  EXPECT_NEAR(std::abs(cuts[0].points[1].across), 0.01, 1e-6);
  EXPECT_NEAR(std::abs(cuts[0].points[1].along), 0.2, 1e-6);
}

TEST(SectionCut, IsUprightAtAFloorAndNoneWhereNothingMeets) {
  PipelineResult result = two_at_a_wall();
  result.links[0].residuals.contact->normal = Eigen::Vector3d::UnitZ();
  EXPECT_FALSE(choose_sections(result).at(0).is_level);
  result.links[0].residuals.contact.reset();
  EXPECT_TRUE(choose_sections(result).empty());
  result = two_at_a_wall();
  result.poses[1].status = ScanStatus::kUnregistered;
  EXPECT_TRUE(choose_sections(result).empty());
}

}  // namespace
}  // namespace tcm_icp
