#include "tcm_icp/registration/scan_pyramid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

Cloud yard(std::uint64_t seed) {
  Rng rng = make_stream(seed, "scan_pyramid_test");
  return testing::synthetic_scene({.num_scans = 1, .points_per_scan = 6000}, rng).scans[0];
}

TEST(ScanPyramid, VoxelsDoubleAndPointsThinOutFromLevelToLevel) {
  const ScanPyramid pyramid(yard(1), 0.25, 4);
  ASSERT_EQ(pyramid.num_levels(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const PyramidLevel& level = pyramid.level(i);
    EXPECT_EQ(level.voxel_size_m, 0.25 * static_cast<double>(1 << i));
    EXPECT_EQ(level.index.size(), level.cloud.size());
    EXPECT_TRUE(level.cloud.has_normals());
    if (i > 0) {
      EXPECT_LT(level.cloud.size(), pyramid.level(i - 1).cloud.size());
    }
  }
  // On surfaces the points go down with the area, by four, once voxels are well above the spacing.
  const double ratio =
      static_cast<double>(pyramid.level(2).cloud.size()) / static_cast<double>(pyramid.level(3).cloud.size());
  EXPECT_GT(ratio, 2.5);
  EXPECT_LT(ratio, 5);
}

TEST(ScanPyramid, LevelForIsTheCoarsestThatIsFineEnough) {
  const ScanPyramid pyramid(yard(2), 0.25, 3);
  EXPECT_EQ(&pyramid.level_for(0.1), &pyramid.level(0)) << "none is fine enough";
  EXPECT_EQ(&pyramid.level_for(0.25), &pyramid.level(0));
  EXPECT_EQ(&pyramid.level_for(0.49), &pyramid.level(0));
  EXPECT_EQ(&pyramid.level_for(0.5), &pyramid.level(1));
  EXPECT_EQ(&pyramid.level_for(1.0), &pyramid.level(2));
  EXPECT_EQ(&pyramid.level_for(100), &pyramid.level(2));
  // 8 x 0.75 / 3 voxels are two, whatever rounding says.
  EXPECT_EQ(&pyramid.level_for(0.5 * (1 - 1e-12)), &pyramid.level(1));
  EXPECT_EQ(&pyramid.level_for(0.5 * (1 - 1e-3)), &pyramid.level(0));
}

TEST(VoxelSizeFor, FindsAboutTheWantedNumberOfVoxels) {
  const Points points = yard(3).points;
  for (const std::size_t wanted : {100u, 500u, 2000u}) {
    const std::size_t found = count_voxels(points, voxel_size_for(points, wanted));
    EXPECT_GE(found, wanted);
    EXPECT_LE(found, 2 * wanted);
  }
}

// Halved until there are enough, and then by bisection of the logarithm, to a sixteenth of an octave.
double voxel_size_by_bisection(const Points& points, std::size_t wanted) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(p);
  const auto enough = [&](double size) { return count_voxels(points, size) >= wanted; };
  double fine = box.diagonal().norm();
  while (!enough(fine)) fine /= 2;
  double coarse = 2 * fine;
  for (int i = 0; i < 4; ++i) {
    const double middle = std::sqrt(coarse * fine);
    (enough(middle) ? fine : coarse) = middle;
  }
  return fine;
}

TEST(VoxelSizeFor, IsWhatBisectionFinds) {
  Rng rng = make_stream(6, "test");
  Points line, solid;
  for (int i = 0; i < 3000; ++i) {
    line.emplace_back(i + uniform01(rng), 0, 0);
    solid.emplace_back(uniform01(rng), uniform01(rng), uniform01(rng));
  }
  for (const Points& points : {yard(6).points, yard(7).points, line, solid}) {
    for (const std::size_t wanted : {std::size_t{10}, std::size_t{100}, std::size_t{700}, points.size() / 2}) {
      EXPECT_DOUBLE_EQ(voxel_size_for(points, wanted), voxel_size_by_bisection(points, wanted)) << wanted;
    }
  }
}

// A sort tells the counts down to a millionth of the diagonal, where all but the stray lie in a few voxels.
TEST(VoxelSizeFor, IsFoundBesideAStrayPoint) {
  Points points = yard(8).points;
  points.emplace_back(1e9, 0, 0);
  EXPECT_DOUBLE_EQ(voxel_size_for(points, 700), voxel_size_by_bisection(points, 700));
}

TEST(VoxelSizeFor, AsksForNoMoreThanHalfThePoints) {
  const Points points = yard(4).points;
  const std::size_t found = count_voxels(points, voxel_size_for(points, 1'000'000));
  EXPECT_GE(found, points.size() / 2);
  EXPECT_LE(found, points.size());
}

TEST(VoxelSizeFor, ScalesWithThePoints) {
  const Points points = yard(5).points;
  const double size = voxel_size_for(points, 500);
  EXPECT_EQ(voxel_size_for(testing::scaled(points, 1024), 500), 1024 * size);
  // A factor that is no power of two rounds; a point on a voxel's edge may then change the count.
  EXPECT_NEAR(voxel_size_for(testing::scaled(points, 1000), 500), 1000 * size, 1e-9 * 1000 * size);
}

TEST(VoxelSizeFor, EqualPointsHaveNoSize) {
  EXPECT_THROW(voxel_size_for(Points(10, Eigen::Vector3d(1, 2, 3)), 100), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
