#include "merging/merged_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scans/prepared_scan.hpp"
#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;

TEST(MergedCloud, GrowsWithTheAreaAndNotWithTheScans) {
  Rng rng = make_stream(1, "merged_cloud_test");
  const auto scene = testing::synthetic_scene({.num_scans = 2, .points_per_scan = 4000}, rng);
  MergedCloud merged(1.0);
  merged.add(scene.scans[0], Isometry3d::Identity());
  const std::size_t alone = merged.pyramid().level(0).cloud.size();
  EXPECT_EQ(alone, count_voxels(scene.scans[0].points, 1.0));
  merged.add(scene.scans[0], Isometry3d::Identity());
  // A voxel's mean point is in its voxel, so the same scan adds nothing.
  EXPECT_EQ(merged.pyramid().level(0).cloud.size(), alone);
  merged.add(scene.scans[0], Isometry3d(Eigen::Translation3d(1000, 0, 0)));
  EXPECT_GE(merged.pyramid().level(0).cloud.size(),
            2 * alone - 10);  // 1,000 m is a whole number of voxels, up to rounding
}

TEST(MergedCloud, TakesPointsAndNormalsIntoTheReferenceFrame) {
  Rng rng = make_stream(2, "merged_cloud_test");
  const Isometry3d T = testing::random_pose(10, rng);
  MergedCloud merged(0.5);
  merged.add({{{1, 2, 3}}, {Eigen::Vector3d::UnitX()}}, T);
  const Cloud cloud = merged.pyramid().level(0).cloud;
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_TRUE(testing::is_near(T * Eigen::Vector3d(1, 2, 3), cloud.points[0], 1e-12));
  EXPECT_NEAR(std::abs(cloud.normals[0].dot(T.linear().col(0))), 1, 1e-12);
}

TEST(MergedCloud, HasAllPyramidLevels) {
  MergedCloud merged(0.5);
  merged.add({{{1, 2, 3}}, {Eigen::Vector3d::UnitX()}}, Isometry3d::Identity());
  EXPECT_EQ(merged.pyramid().num_levels(), kNumPyramidLevels);
  EXPECT_EQ(merged.pyramid().level(0).voxel_size_m, 0.5);
}

}  // namespace
}  // namespace tcm_icp
