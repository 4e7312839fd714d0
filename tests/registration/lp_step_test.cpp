// One step of lp_registration.hpp, against slow and obvious ways.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/lp_registration.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Points on random planes, displaced by `twist`, with noise.
Correspondences make_matches(std::size_t count, const Twist& twist, double noise_m, Rng& rng) {
  Correspondences matches;
  const Isometry3d T = isometry_from_twist(twist);
  for (const auto& p : testing::random_points(count, 10, rng)) {
    const Vector3d normal = testing::random_pose(0, rng).linear().col(0);
    matches.push_back({T.inverse() * p, p + noise_m * standard_normal(rng) * normal, normal});
  }
  return matches;
}

Vector3d centre_of(const Correspondences& matches) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& m : matches) sum += m.source;
  return sum / static_cast<double>(matches.size());
}

// What the step minimises, term by term.
double l1_cost(const Correspondences& matches, const Twist& twist) {
  const Vector3d centre = centre_of(matches);
  double sum = 0;
  for (const auto& m : matches) {
    const Vector3d moved = m.source + twist.head<3>().cross(m.source - centre) + twist.tail<3>();
    sum += std::abs(m.normal.dot(moved - m.target));
  }
  return sum;
}

// The inverse of isometry_about().
Twist twist_of(const Isometry3d& T, const Vector3d& centre) {
  const Eigen::AngleAxisd rotation(T.linear());
  Twist twist;
  twist << rotation.angle() * rotation.axis(), T * centre - centre;
  return twist;
}

Twist small_twist() {
  Twist twist;
  twist << 0.03, -0.05, 0.04, 0.2, -0.1, 0.3;
  return twist;
}

TEST(LpPointToPlaneStep, NoTwistNearbyHasALowerCost) {
  Rng rng = make_stream(1, "lp_step_test");
  const auto matches = make_matches(200, small_twist(), 0.1, rng);
  LpFigures figures;
  Isometry3d T = Isometry3d::Identity();
  double step_m = 0;
  ASSERT_EQ(lp_point_to_plane_step(matches, {}, T, figures, step_m), Termination::kConverged);
  const Twist found = twist_of(T, centre_of(matches));
  const double cost = l1_cost(matches, found);
  ASSERT_GT(l1_cost(matches, Twist::Zero()), 1.2 * cost);
  EXPECT_NEAR(figures.objective, cost, 1e-9 * cost);
  EXPECT_LE(figures.relative_duality_gap, 1e-7);
  // Noise against ties moves the optimum by up to 2e-6 median |d| a row (l1_fit.hpp): 200 rows of below 0.5 m.
  constexpr double kTieBreaking = 2e-4;
  for (const double size : {1.0, 0.1, 0.01, 0.001, 1e-4}) {
    for (int i = 0; i < 300; ++i) {
      Twist other;
      for (double& entry : other) entry = size * standard_normal(rng);
      ASSERT_LE(cost, l1_cost(matches, found + other) + kTieBreaking) << "twist of size " << size;
    }
  }
}

TEST(LpPointToPlaneStep, GlpkAndCgalTakeTheSameStep) {
  Rng rng = make_stream(2, "lp_step_test");
  const auto matches = make_matches(60, small_twist(), 0.1, rng);
  Isometry3d T[2] = {Isometry3d::Identity(), Isometry3d::Identity()};
  LpFigures figures[2];
  for (const LpSolver solver : {LpSolver::kGlpk, LpSolver::kCgal}) {
    const std::size_t i = solver == LpSolver::kGlpk ? 0 : 1;
    L1FitOptions options;
    options.lp.solver = solver;
    double step_m = 0;
    ASSERT_EQ(lp_point_to_plane_step(matches, options, T[i], figures[i], step_m), Termination::kConverged);
    EXPECT_GT(step_m, 0.1);
    EXPECT_GT(figures[i].num_pivots, 0);
  }
  // Both end in the same vertex: the noise against ties is the same.
  EXPECT_TRUE(testing::is_pose_near(T[0], T[1], 1e-9, 1e-9));
  EXPECT_NEAR(figures[0].objective, figures[1].objective, 1e-9 * figures[0].objective);
}

TEST(LpPointToPlaneStep, AThirdOfGrossErrorsDoesNotMoveTheSmallStep) {
  Rng rng = make_stream(3, "lp_step_test");
  auto matches = make_matches(150, 1e-5 * small_twist(), 0, rng);
  for (std::size_t i = 0; i < matches.size(); i += 3) matches[i].target += Vector3d(1, -2, 3) * standard_normal(rng);
  LpFigures figures;
  Isometry3d T = Isometry3d::Identity();
  double step_m = 0;
  ASSERT_EQ(lp_point_to_plane_step(matches, {}, T, figures, step_m), Termination::kConverged);
  const Isometry3d truth = isometry_from_twist(1e-5 * small_twist());
  ASSERT_FALSE(testing::is_pose_near(truth, Isometry3d::Identity(), 1e-8, 1e-8));
  // The linearisation is off by the square of the rotation, 5e-13 rad^2, over 5 m.
  EXPECT_TRUE(testing::is_pose_near(truth, T, 1e-10, 1e-10));
}

TEST(LpPointToPlaneStep, MatchesInOnePlaceOrNoneAreTooFew) {
  LpFigures figures;
  double step_m = 0;
  const Isometry3d start = isometry_from_twist(small_twist());
  for (const std::size_t count : {0u, 1u, 20u}) {
    Isometry3d T = start;
    const Correspondences matches(count, {{1, 2, 3}, {1, 2, 4}, {0, 0, 1}});
    EXPECT_EQ(lp_point_to_plane_step(matches, {}, T, figures, step_m), Termination::kTooFewCorrespondences);
    EXPECT_TRUE(T.isApprox(start, 0));
  }
  EXPECT_EQ(figures.num_programs, 0);
}

constexpr LpFormulation kFormulations[] = {LpFormulation::kPointToPlane, LpFormulation::kPointToPoint,
                                           LpFormulation::kEntries, LpFormulation::kLeastSquares};

TEST(RegistrationStep, EveryFormulationFindsAnExactMotion) {
  Rng rng = make_stream(4, "lp_step_test");
  const auto matches = make_matches(150, 1e-3 * small_twist(), 0, rng);
  const Isometry3d truth = isometry_from_twist(1e-3 * small_twist());
  ASSERT_FALSE(testing::is_pose_near(truth, Isometry3d::Identity(), 3e-5, 1e-4));
  for (const LpFormulation formulation : kFormulations) {
    LpFigures figures;
    Isometry3d T = Isometry3d::Identity();
    double step_m = 0;
    ASSERT_EQ(registration_step(formulation, matches, {}, T, figures, step_m), Termination::kConverged);
    // The linearisation is off by the square of the rotation, 5e-9 rad^2, over 10 m; the noise against ties is 1e-6 of
    // the coordinates where they are what is fitted (12 entries), and averages out over 150 matches.
    EXPECT_TRUE(testing::is_pose_near(truth, T, 3e-7, 1e-6)) << static_cast<int>(formulation);
    EXPECT_GT(step_m, 1e-4);
    EXPECT_EQ(figures.num_programs, formulation == LpFormulation::kLeastSquares ? 0
                                    : formulation == LpFormulation::kEntries    ? 3
                                                                                : 1);
  }
}

TEST(RegistrationStep, GrossErrorsMoveLeastSquaresAndNotTheProgram) {
  Rng rng = make_stream(5, "lp_step_test");
  auto matches = make_matches(150, 1e-3 * small_twist(), 0, rng);
  for (std::size_t i = 0; i < matches.size(); i += 5) matches[i].target += Vector3d(1, 2, 3);
  const auto error_m = [&](LpFormulation formulation) {
    LpFigures figures;
    Isometry3d T = Isometry3d::Identity();
    double step_m = 0;
    EXPECT_EQ(registration_step(formulation, matches, {}, T, figures, step_m), Termination::kConverged);
    return (T.translation() - isometry_from_twist(1e-3 * small_twist()).translation()).norm();
  };
  for (const LpFormulation formulation :
       {LpFormulation::kPointToPlane, LpFormulation::kPointToPoint, LpFormulation::kEntries}) {
    EXPECT_LT(error_m(formulation), 1e-6) << static_cast<int>(formulation);
  }
  EXPECT_GT(error_m(LpFormulation::kLeastSquares), 0.05);
}

TEST(RegistrationStep, MatchesInOnePlaceAreTooFewForEveryFormulation) {
  const Correspondences matches(3, {{1, 2, 3}, {1, 2, 4}, {0, 0, 1}});
  for (const LpFormulation formulation : kFormulations) {
    LpFigures figures;
    Isometry3d T = Isometry3d::Identity();
    double step_m = 0;
    EXPECT_EQ(registration_step(formulation, matches, {}, T, figures, step_m), Termination::kTooFewCorrespondences);
    EXPECT_TRUE(T.isApprox(Isometry3d::Identity(), 0));
  }
}

}  // namespace
}  // namespace tcm_icp
