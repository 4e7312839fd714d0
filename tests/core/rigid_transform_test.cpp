#include "tcm_icp/core/rigid_transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Isometry3d large_motion() {
  Twist twist;
  twist << 1.1, -0.8, 0.7, 3, -4, 5;
  return isometry_from_twist(twist);
}

TEST(RigidTransform, TwistTurnsByItsVectorThenShifts) {
  Twist twist;
  twist << 0, 0, kPi / 2, 10, 20, 30;  // a quarter turn takes x to y
  EXPECT_TRUE(
      testing::is_near(Eigen::Vector3d(10, 21, 30), isometry_from_twist(twist) * Eigen::Vector3d(1, 0, 0), 1e-14));
}

TEST(RigidTransform, ZeroAndTinyTwistsHaveNoSingularity) {
  EXPECT_TRUE(testing::is_near(Eigen::Matrix4d::Identity(), isometry_from_twist(Twist::Zero()).matrix(), 0));
  Twist tiny = Twist::Zero();
  tiny[0] = 1e-12;
  EXPECT_NEAR(isometry_from_twist(tiny).linear()(2, 1), 1e-12, 1e-24);
}

TEST(RigidTransform, MotionAboutACentreLeavesItThereButForTheShift) {
  Twist twist;
  twist << 0.5, 1.5, -1, 1, 2, 3;
  const Eigen::Vector3d centre(100, 200, -50);
  EXPECT_TRUE(testing::is_near(centre + Eigen::Vector3d(1, 2, 3), isometry_about(centre, twist) * centre, 1e-12));
}

TEST(RigidTransform, AngleKeepsItsPrecisionNearBothEnds) {
  for (const double angle : {0.0, 1e-9, 0.3, 2.0, kPi - 1e-9, kPi}) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -2) / 3).toRotationMatrix();
    EXPECT_NEAR(rotation_angle_rad(R), angle, 1e-14);
  }
}

TEST(RigidTransform, ProjectionKeepsRotationsAndUndoesSmallErrors) {
  const Eigen::Matrix3d R = large_motion().linear();
  EXPECT_TRUE(testing::is_near(R, project_onto_so3(R), 1e-14));
  EXPECT_TRUE(testing::is_near(R, project_onto_so3(7 * R), 1e-14));  // nearest to a multiple
  const Eigen::Matrix3d projected = project_onto_so3(R + 0.1 * Eigen::Matrix3d::Ones());
  EXPECT_TRUE(testing::is_near(Eigen::Matrix3d::Identity(), projected * projected.transpose(), 1e-14));
}

TEST(RigidTransform, ProjectionOfAMirrorIsARotation) {
  EXPECT_NEAR(project_onto_so3(Eigen::Vector3d(1, 1, -1).asDiagonal()).determinant(), 1, 1e-14);
}

TEST(RigidTransform, TellsRigidFromNot) {
  const Eigen::Matrix4d rigid = large_motion().matrix();
  EXPECT_TRUE(is_rigid(rigid, 1e-12));
  Eigen::Matrix4d m = rigid;
  m.topLeftCorner<3, 3>() *= 1.001;
  EXPECT_FALSE(is_rigid(m, 1e-9));
  m = rigid;
  m.col(0) *= -1;
  EXPECT_FALSE(is_rigid(m, 1e-9)) << "a mirror";
  m = rigid;
  m(3, 0) = 0.1;
  EXPECT_FALSE(is_rigid(m, 1e-9));
  m = rigid;
  m(0, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_rigid(m, 1e-9));
}

TEST(RigidTransform, RmsDisplacementOfATurnIsWorkedOutByHand) {
  // Half a turn about z moves (1,0,0) by 2 and (3,0,0) by 6: sqrt((4 + 36) / 2).
  const Eigen::Isometry3d half_turn(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(rms_displacement(half_turn, {{1, 0, 0}, {3, 0, 0}}), std::sqrt(20.0), 1e-14);
  EXPECT_TRUE(std::isnan(rms_displacement(half_turn, Points{})));
}

TEST(RigidTransform, MomentsTellTheRmsDisplacement) {
  Rng rng = make_stream(5, "rigid_transform_test");
  for (int k = 0; k < 20; ++k) {
    const Points points = testing::random_points(50, 30, rng);
    const Eigen::Isometry3d E = testing::random_pose(20, rng);
    const double by_points = rms_displacement(E, points);
    EXPECT_NEAR(rms_displacement(E, PointMoments(points)), by_points, 1e-12 * by_points);
  }
  EXPECT_EQ(rms_displacement(Eigen::Isometry3d::Identity(), PointMoments({{1, 2, 3}, {4, 5, 7}})), 0);
  EXPECT_TRUE(std::isnan(rms_displacement(Eigen::Isometry3d::Identity(), PointMoments(Points{}))));
}

TEST(RigidTransform, MovesPointsAndOnlyTurnsNormals) {
  const Eigen::Isometry3d T = large_motion();
  const Cloud moved = transformed({{{1, 2, 3}}, {{0, 0, 1}}}, T);
  EXPECT_TRUE(testing::is_near(T.linear() * Eigen::Vector3d(1, 2, 3) + T.translation(), moved.points[0], 1e-14));
  EXPECT_TRUE(testing::is_near(T.linear().col(2), moved.normals[0], 1e-15));
}

TEST(Matchers, FailOnNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(testing::is_near(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, nan, 0), 1e9));
  EXPECT_FALSE(testing::is_near(Eigen::Vector3d(0, 0, 0), Eigen::Vector2d(0, 0), 1e9));
  Eigen::Isometry3d broken = Eigen::Isometry3d::Identity();
  broken.matrix()(0, 3) = nan;
  EXPECT_FALSE(testing::is_pose_near(Eigen::Isometry3d::Identity(), broken, 9, 1e9));
  broken = Eigen::Isometry3d::Identity();
  broken.matrix()(0, 1) = nan;
  EXPECT_FALSE(testing::is_pose_near(Eigen::Isometry3d::Identity(), broken, 9, 1e9));
  EXPECT_TRUE(testing::is_pose_near(large_motion(), large_motion(), 1e-12, 0));
}

}  // namespace
}  // namespace tcm_icp
