#include "tcm_icp/tcm/tcm.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using testing::random_points;
using testing::scaled;
using testing::shuffled;

// A motion with a large rotation about several axes: a small one would hide a reversed product.
Eigen::Isometry3d large_motion() {
  Twist twist;
  twist << 1.1, -0.8, 0.7, 3, -4, 5;
  return isometry_from_twist(twist);
}

// Small clouds with every value worked out by hand.
//   a = (0,0,0) (2,0,0) (4,0,0)          C(a) = (2,0,0)
//   b = (0,3,0) (1,3,0) (8,3,0) (3,7,0)  C(b) = (3,4,0)
const Points kA{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};
const Points kB{{0, 3, 0}, {1, 3, 0}, {8, 3, 0}, {3, 7, 0}};

TEST(Tcm, CentroidIsTheMeanOfThePoints) {
  EXPECT_TRUE(testing::is_near(Eigen::Vector3d(2, 0, 0), TcmCloud(kA).centroid(), 0));
  EXPECT_TRUE(testing::is_near(Eigen::Vector3d(3, 4, 0), TcmCloud(kB).centroid(), 0));
}

TEST(Tcm, FIsTheSumOfTheLeastSquaredDistancesToTheOthersCentroid) {
  // X: a to C(b): 9 + 16 = 25, 1 + 16 = 17, 1 + 16 = 17: least 17.
  // Y: b to C(a): 4 + 9 = 13, 1 + 9 = 10, 36 + 9 = 45, 1 + 49 = 50: least 10.
  EXPECT_DOUBLE_EQ(tcm_f(TcmCloud(kA), TcmCloud(kB)), 17 + 10);
}

TEST(Tcm, GIsTheDifferenceOfTheLeastSquaredSpacingsWithoutSign) {
  // M: 2^2 = 4, both gaps of a. N: (0,3,0)-(1,3,0): 1.
  EXPECT_DOUBLE_EQ(TcmCloud(kA).min_squared_distance_m2(), 4);
  EXPECT_DOUBLE_EQ(TcmCloud(kB).min_squared_distance_m2(), 1);
  EXPECT_DOUBLE_EQ(tcm_g(TcmCloud(kA), TcmCloud(kB)), 3);
  EXPECT_DOUBLE_EQ(tcm_g(TcmCloud(kB), TcmCloud(kA)), 3);
}

TEST(Tcm, HIsOneOverTheProductOfTheCounts) {
  EXPECT_DOUBLE_EQ(tcm_h(TcmCloud(kA), TcmCloud(kB)), 1.0 / 12);  // 3 * 4
}

TEST(Tcm, TauIsTheProductOfTheThree) {
  EXPECT_DOUBLE_EQ(tcm({kA, {}}, {kB, {}}), 27.0 * 3 / 12);  // 6.75
}

TEST(Tcm, MovesTheSecondCloudByThePose) {
  // b moved by (0, -4, 0): C(b) = (3,0,0); X: least of 9, 1, 1 = 1. Y: points at y = -1: 4 + 1, 1 + 1 = 2, ...: 2.
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().y() = -4;
  EXPECT_DOUBLE_EQ(tcm_f(TcmCloud(kA), TcmCloud(kB), T), 3);
}

TEST(Tcm, ADuplicatePointMakesTheLeastSpacingZero) {
  EXPECT_EQ(TcmCloud({{0, 0, 0}, {5, 0, 0}, {5, 0, 0}}).min_squared_distance_m2(), 0);
  EXPECT_EQ(TcmCloud({{1, 2, 3}, {1, 2, 3}}).min_squared_distance_m2(), 0);
}

TEST(Tcm, EqualSpacingsGiveZero) {
  const Points moved{{0, 9, 0}, {2, 9, 0}};
  EXPECT_EQ(tcm({kA, {}}, {moved, {}}), 0);
}

TEST(Tcm, CollinearCloudsHaveAValue) {
  const Points line{{0, 0, 0}, {0, 0, 3}, {0, 0, 9}};
  // C = (0,0,4). X: a to C: 16, 4 + 16, ...: 16. Y: line to (2,0,0): 4, 13, ...: 4. |4 - 9| = 5; 1 / 9.
  EXPECT_DOUBLE_EQ(tcm({kA, {}}, {line, {}}), 20.0 * 5 / 9);
}

TEST(Tcm, RefusesCloudsWithoutAPairOfFinitePoints) {
  EXPECT_THROW(TcmCloud(Points{}), InvalidInput);
  EXPECT_THROW(TcmCloud(Points{{1, 2, 3}}), InvalidInput);
  EXPECT_THROW(TcmCloud(Points{{1, 2, 3}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}}), InvalidInput);
  EXPECT_THROW(tcm({kA, {}}, {{}, {}}), InvalidInput);
}

class TcmProperties : public ::testing::Test {
 protected:
  Rng rng = make_stream(7, "tcm_test");
  Points a = random_points(200, 10, rng);
  Points b = scaled(random_points(300, 10, rng), 1.5);
  double tau = tcm({a, {}}, {b, {}});
  // Coordinates of size 10 carry 1e-15; the least spacing (about 0.1) enters squared: 1e-12 relative, with room.
  double tolerance = 1e-11 * tau;
};

TEST_F(TcmProperties, TheCaseIsNotTrivial) { ASSERT_GT(tau, 1e-9); }

TEST_F(TcmProperties, DoesNotDependOnWhichCloudIsNamedFirst) { EXPECT_NEAR(tcm({b, {}}, {a, {}}), tau, tolerance); }

TEST_F(TcmProperties, DoesNotDependOnTheOrderOfThePoints) {
  EXPECT_NEAR(tcm({shuffled(a, rng), {}}, {shuffled(b, rng), {}}), tau, tolerance);
}

TEST_F(TcmProperties, IsUnchangedWhenBothCloudsMoveTogether) {
  EXPECT_NEAR(tcm(transformed({a, {}}, large_motion()), transformed({b, {}}, large_motion())), tau, tolerance);
}

TEST_F(TcmProperties, ChangesWhenOneCloudMoves) {
  EXPECT_GT(std::abs(tcm({a, {}}, transformed({b, {}}, large_motion())) - tau), 1e3 * tolerance);
}

TEST_F(TcmProperties, ScalesWithTheFourthPower) {
  const double s = 1000;
  const TcmTerms before = tcm_terms(TcmCloud(a), TcmCloud(b));
  const TcmTerms after = tcm_terms(TcmCloud(scaled(a, s)), TcmCloud(scaled(b, s)));
  EXPECT_NEAR(after.f / before.f, s * s, 1e-9 * s * s);
  EXPECT_NEAR(after.g / before.g, s * s, 1e-9 * s * s);
  EXPECT_DOUBLE_EQ(after.h, before.h);
  EXPECT_NEAR(after.tau() / before.tau(), s * s * s * s, 1e-9 * s * s * s * s);
}

TEST_F(TcmProperties, EvaluatorAgreesWithMovingTheCloud) {
  const TcmCloud fixed(a), moving(b);
  const TcmEvaluator evaluator(fixed, moving);
  Twist twist = Twist::Zero();
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 6; ++k) twist[k] = 3 * (uniform01(rng) - 0.5);
    const Eigen::Isometry3d T = isometry_from_twist(twist);
    const double direct = tcm({a, {}}, transformed({b, {}}, T));
    EXPECT_NEAR(evaluator(T), direct, 1e-10 * direct);
  }
}

}  // namespace
}  // namespace tcm_icp
