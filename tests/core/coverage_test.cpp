#include "tcm_icp/core/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

constexpr double kExtent_m = 20;

// Counted from a 4096th of the extent on, as those of scans are.
double coverage_of(const Points& points, double extent_m) {
  return coverage_m(VoxelOctaves(points, Vector3d::Zero(), extent_m / 4096));
}

// Of 20 x 20 m, oblique to the axes, off the grid's regularity by a third of the spacing.
Points plane(double spacing_m, Rng& rng) {
  const Eigen::Isometry3d T = testing::random_pose(0, rng);
  const int n = static_cast<int>(kExtent_m / spacing_m);
  Points points;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = i + 0.3 * uniform01(rng), y = j + 0.3 * uniform01(rng);
      points.push_back(T * Vector3d(x * spacing_m, y * spacing_m, 0));
    }
  }
  return points;
}

// Parallel lines on a plane, `apart_m` from one another, a point each tenth of that.
Points lines(double apart_m, Rng& rng) {
  const Eigen::Isometry3d T = testing::random_pose(0, rng);
  const double along_m = apart_m / 10;
  Points points;
  for (int i = 0; i * apart_m < kExtent_m; ++i) {
    for (int j = 0; j * along_m < kExtent_m; ++j) {
      points.push_back(T * Vector3d((j + 0.3 * uniform01(rng)) * along_m, i * apart_m, 0));
    }
  }
  return points;
}

TEST(Coverage, OfAPlaneGridIsAboutItsSpacing) {
  Rng rng = make_stream(1, "coverage_test");
  for (const double spacing_m : {0.1, 0.25, 0.6}) {
    const double found_m = coverage_of(plane(spacing_m, rng), kExtent_m);
    EXPECT_GT(found_m, spacing_m / 1.5) << spacing_m;
    EXPECT_LT(found_m, 1.5 * spacing_m) << spacing_m;
  }
}

// Half of it, where voxels begin to meet two lines. Points along a line have a tenth of it.
TEST(Coverage, OfLinesIsTheirDistanceNotTheSpacingAlongThem) {
  Rng rng = make_stream(2, "coverage_test");
  for (const double apart_m : {0.3, 0.6}) {
    const double found_m = coverage_of(lines(apart_m, rng), kExtent_m);
    EXPECT_GT(found_m, apart_m / 3) << apart_m;
    EXPECT_LT(found_m, 1.5 * apart_m) << apart_m;
  }
}

// A scanner 1.5 m above the ground: rings of 4 to 12 m, 0.4 m apart, each point 0.04 m from the next.
TEST(Coverage, OfRingsIsAboutTheDistanceOfRings) {
  Rng rng = make_stream(3, "coverage_test");
  const Eigen::Isometry3d T = testing::random_pose(0, rng);
  Points points;
  for (double radius_m = 4; radius_m < 12; radius_m += 0.4) {
    const int n = static_cast<int>(2 * std::numbers::pi * radius_m / 0.04);
    const double start = uniform01(rng);
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * (k + start) / n;
      points.push_back(T * Vector3d(radius_m * std::cos(angle), radius_m * std::sin(angle), -1.5));
    }
  }
  const double found_m = coverage_of(points, 12);
  EXPECT_GT(found_m, 0.2);
  EXPECT_LT(found_m, 1);
}

Points with_isolated(Points points, double share, Rng& rng) {
  const Points isolated =
      testing::random_points(static_cast<std::size_t>(share * static_cast<double>(points.size())), kExtent_m, rng);
  points.insert(points.end(), isolated.begin(), isolated.end());
  return points;
}

// Each is a voxel of its own at any edge, which hid the surfaces: coverage came out ten times as long.
TEST(Coverage, IsolatedPointsDoNotHideAPlane) {
  Rng rng = make_stream(9, "coverage_test");
  const Points surface = plane(0.2, rng);
  const double found_m = coverage_of(surface, kExtent_m);
  for (const double share : {0.05, 0.1, 0.2}) {
    const double with_m = coverage_of(with_isolated(surface, share, rng), kExtent_m);
    EXPECT_GT(with_m, found_m / 1.5) << share;
    EXPECT_LT(with_m, 1.5 * found_m) << share;
  }
}

// With twice as many some lie as near one another as voxels of lines do where these meet, and coverage is 4 times as
// long.
TEST(Coverage, FewIsolatedPointsDoNotHideLines) {
  Rng rng = make_stream(11, "coverage_test");
  const Points surface = lines(0.4, rng);
  const double found_m = coverage_of(surface, kExtent_m);
  const double with_m = coverage_of(with_isolated(surface, 0.05, rng), kExtent_m);
  EXPECT_GT(with_m, found_m / 2);
  EXPECT_LT(with_m, 2 * found_m);
}

TEST(Coverage, OfIsolatedPointsAloneIsNotThatOfSurfaces) {
  Rng rng = make_stream(10, "coverage_test");
  const Points points = testing::random_points(2000, kExtent_m, rng);
  const double apart_m = kExtent_m / std::cbrt(2000.0);
  EXPECT_GT(coverage_of(points, kExtent_m), apart_m / 3);
}

TEST(Coverage, ScalesWithThePointsAndTheirExtent) {
  Rng rng = make_stream(4, "coverage_test");
  const Points points = plane(0.2, rng);
  const double found_m = coverage_of(points, kExtent_m);
  ASSERT_GT(found_m, 0);
  EXPECT_EQ(coverage_of(testing::scaled(points, 1024), 1024 * kExtent_m), 1024 * found_m) << "to the bit";
  // Points on voxel borders may fall to either side in units of no power of two.
  EXPECT_NEAR(coverage_of(testing::scaled(points, 1000), 1000 * kExtent_m), 1000 * found_m, 1e-3 * 1000 * found_m);
}

TEST(Coverage, TheExtentNeedNotBeExact) {
  Rng rng = make_stream(5, "coverage_test");
  const Points points = plane(0.2, rng);
  for (const double factor : {0.5, 0.8, 1.3, 2.0}) {
    const double found_m = coverage_of(points, factor * kExtent_m);
    EXPECT_GT(found_m, 0.1) << factor;
    EXPECT_LT(found_m, 0.5) << factor;
  }
}

TEST(Coverage, TheOrderOfThePointsDoesNotMatter) {
  Rng rng = make_stream(6, "coverage_test");
  const Points points = plane(0.3, rng);
  EXPECT_EQ(coverage_of(testing::shuffled(points, rng), kExtent_m), coverage_of(points, kExtent_m));
}

TEST(Coverage, PointsOnALineAlongAnAxisCoverNothing) {
  for (int axis = 0; axis < 3; ++axis) {
    Points points;
    for (int i = 0; i < 5000; ++i) points.push_back(kExtent_m * i / 5000 * Vector3d::Unit(axis));
    EXPECT_EQ(coverage_of(points, kExtent_m), 0) << axis;
  }
}

TEST(Coverage, PointsOnAnyLineCoverNothing) {
  Rng rng = make_stream(7, "coverage_test");
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Isometry3d T = testing::random_pose(5, rng);
    Points points;
    for (int i = 0; i < 5000; ++i) points.push_back(T * Vector3d(kExtent_m * i / 5000, 0, 0));
    EXPECT_EQ(coverage_of(points, kExtent_m), 0) << trial;
  }
}

TEST(Coverage, FewPointsCoverNothing) {
  Rng rng = make_stream(8, "coverage_test");
  EXPECT_EQ(coverage_of({}, kExtent_m), 0);
  EXPECT_EQ(coverage_of({Vector3d(1, 2, 3)}, kExtent_m), 0);
  EXPECT_EQ(coverage_of(Points(1000, Vector3d(1, 2, 3)), kExtent_m), 0) << "duplicates";
  for (int trial = 0; trial < 5; ++trial) {
    EXPECT_EQ(coverage_of(testing::random_points(63, kExtent_m, rng), kExtent_m), 0) << trial;
  }
}

}  // namespace
}  // namespace tcm_icp
