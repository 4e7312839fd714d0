#include "links/overlaps_at_poses.hpp"

#include <gtest/gtest.h>

#include "pipeline/prepared_scene.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

using testing::PreparedScene;

PreparedScene overlapping_scans() {
  Rng rng = make_stream(7, "overlaps_at_poses_test");
  return testing::prepared_scene({.num_scans = 2, .points_per_scan = 15000, .noise_m = 0.01}, rng);
}

Eigen::Isometry3d aside(Eigen::Isometry3d T, double metres) {
  T.pretranslate(Eigen::Vector3d(metres, 0, 0));
  return T;
}

TEST(OverlapsAtPoses, IsTheOverlapOfTheCoarsestClouds) {
  const PreparedScene s = overlapping_scans();
  OverlapsAtPoses overlaps(s.scans, 1);
  const Eigen::Isometry3d T = s.scene.T_target_source(0, 1);
  const std::vector<double> found = overlaps.at({{0, 1, T}, {0, 1, aside(T, 5)}}, 0);
  const PyramidLevel &a = s.scans[0].pyramid.level(2), &b = s.scans[1].pyramid.level(2);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], overlap(a, b, T, 2 * a.voxel_size_m));
  EXPECT_EQ(found[1], overlap(a, b, aside(T, 5), 2 * a.voxel_size_m));
  EXPECT_GT(found[0], found[1]);
}

TEST(OverlapsAtPoses, TakesWhatItKnowsOfTheSamePose) {
  const PreparedScene s = overlapping_scans();
  OverlapsAtPoses overlaps(s.scans, 1);
  const Eigen::Isometry3d T = s.scene.T_target_source(0, 1);
  const double there = overlaps.at({{0, 1, T}}, 1)[0];
  EXPECT_EQ(overlaps.at({{0, 1, aside(T, 0.9)}}, 1)[0], there) << "within what is the same";
  EXPECT_NE(overlaps.at({{0, 1, aside(T, 1.5)}}, 1)[0], there);
}

TEST(OverlapsAtPoses, IsNoneWhereExtentsCannotMeet) {
  const PreparedScene s = overlapping_scans();
  OverlapsAtPoses overlaps(s.scans, 1);
  const Eigen::Isometry3d far = aside(s.scene.T_target_source(0, 1), 1e4);
  EXPECT_FALSE(overlaps.may_overlap(0, 1, far));
  EXPECT_TRUE(overlaps.may_overlap(0, 1, s.scene.T_target_source(0, 1)));
  EXPECT_EQ(overlaps.at({{0, 1, far}}, 0)[0], 0);
}

TEST(OverlapsAtPoses, ThoseThatOverlapMostAreChosenForEitherScan) {
  const Eigen::Isometry3d I = Eigen::Isometry3d::Identity();
  const std::vector<ImpliedPose> poses{{0, 1, I}, {0, 2, I}, {0, 3, I}, {2, 3, I}};
  // 2 has but one partner besides 0; of 0 and 3 the better ones count.
  EXPECT_EQ(most_overlapping(poses, {0.9, 0.5, 0.6, 0.7}, 1), (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(most_overlapping(poses, {0.9, 0.5, 0.6, 0.7}, 3), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(most_overlapping(poses, {0.9, 0, 0, 0.7}, 3), (std::vector<std::size_t>{0, 3})) << "some overlap at all";
}

}  // namespace
}  // namespace tcm_icp
