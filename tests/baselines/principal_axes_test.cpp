#include "tcm_icp/baselines/principal_axes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

// A yard: three different variances, and no symmetry.
Points yard(Rng& rng) {
  testing::SyntheticSceneOptions options;
  options.num_scans = 1;
  return testing::synthetic_scene(options, rng).scans[0].points;
}

Points moved(const Points& points, const Eigen::Isometry3d& T) { return transformed({points, {}}, T).points; }

TEST(PrincipalAxes, OneOfTheFourIsTheMotionOfACopy) {
  Rng rng = make_stream(1, "principal_axes_test");
  const Points points = yard(rng);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Isometry3d T = testing::random_pose(100, rng);
    ASSERT_GT(testing::pose_rmse_m(T, Eigen::Isometry3d::Identity(), points), 1);
    const auto four = principal_axes_alignments(moved(points, T), points);
    // Rounding of coordinates of 100 m, through an eigen decomposition.
    EXPECT_TRUE(std::any_of(four.begin(), four.end(),
                            [&](const auto& A) { return testing::pose_rmse_m(T, A, points) < 1e-6; }));
  }
}

TEST(PrincipalAxes, AllFourAreRigidAndDifferent) {
  Rng rng = make_stream(2, "principal_axes_test");
  const Points points = yard(rng);
  const auto four = principal_axes_alignments(moved(points, testing::random_pose(10, rng)), points);
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_TRUE(is_rigid(four[a].matrix(), 1e-9));
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(testing::pose_rmse_m(four[a], four[b], points), 1);
  }
}

TEST(PrincipalAxes, TheLeastMeanDistancePicksTheRightOne) {
  Rng rng = make_stream(3, "principal_axes_test");
  const Points points = yard(rng);
  const Eigen::Isometry3d T = testing::random_pose(100, rng);
  const Points target = moved(points, T);
  EXPECT_LT(testing::pose_rmse_m(T, coarse_alignment_by_axes(target, NeighborIndex(target), points), points), 1e-6);
}

TEST(PrincipalAxes, PointsOnALineStillGiveRigidMotions) {
  const Points line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, across{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  for (const auto& T : principal_axes_alignments(across, line)) {
    EXPECT_TRUE(is_rigid(T.matrix(), 1e-9));
    EXPECT_NEAR((T * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 1, 0)).norm(), 0, 1e-12) << "middle to middle";
  }
}

TEST(PrincipalAxes, NoPointsAreRefused) {
  EXPECT_THROW(principal_axes_alignments({}, {{0, 0, 0}}), InvalidInput);
  EXPECT_THROW(principal_axes_alignments({{0, 0, 0}}, {}), InvalidInput);
}

TEST(MeanNearestDistance, IsThatOfALoop) {
  const Points target{{0, 0, 0}, {10, 0, 0}}, source{{1, 0, 0}, {7, 0, 0}};
  const NeighborIndex index(target);
  EXPECT_DOUBLE_EQ(mean_nearest_distance(source, index, Eigen::Isometry3d::Identity()), 2);
  const Eigen::Isometry3d shift(Eigen::Translation3d(-1, 0, 0));
  EXPECT_DOUBLE_EQ(mean_nearest_distance(source, index, shift), 2);
  EXPECT_TRUE(std::isnan(mean_nearest_distance({}, index, shift)));
}

}  // namespace
}  // namespace tcm_icp
