#include "tcm_icp/registration/alignment_objective.hpp"

#include <gtest/gtest.h>

#include "registration/level_of.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::level_of;

constexpr double kScale = 0.2, kGate = 2;  // [m]

struct ObjectiveCase {
  Cloud source;
  PyramidLevel target;
  Isometry3d truth, off;
};

ObjectiveCase objective_case(std::uint64_t seed) {
  Rng rng = make_stream(seed, "alignment_objective_test");
  const testing::SyntheticScene scene = testing::synthetic_scene({.points_per_scan = 1500, .noise_m = 0.02}, rng);
  const Isometry3d truth = scene.T_target_source(0, 1);
  return {scene.scans[1], level_of(scene.scans[0]), truth,
          testing::perturbed(truth, scene.scans[1].points, 0.03, 0.15, rng)};
}

TEST(AlignmentObjective, IsZeroForTheSameCloudAndOneOutOfReach) {
  const ObjectiveCase c = objective_case(1);
  const AlignmentObjective objective(c.target.cloud, c.target, kScale, kGate);
  EXPECT_EQ(objective.cost(Isometry3d::Identity()), 0);
  EXPECT_EQ(objective.cost(Isometry3d(Eigen::Translation3d(1000, 0, 0))), 1);
}

TEST(AlignmentObjective, IsBetweenZeroAndOneAndGrowsWithTheError) {
  const ObjectiveCase c = objective_case(2);
  const AlignmentObjective objective(c.source, c.target, kScale, kGate);
  Rng rng = make_stream(2, "alignment_objective_test poses");
  for (int i = 0; i < 20; ++i) {
    const double cost = objective.cost(testing::perturbed(c.truth, c.source.points, 0.3 * i, 0.5 * i, rng));
    EXPECT_GE(cost, 0);
    EXPECT_LE(cost, 1);
  }
  EXPECT_LT(objective.cost(c.truth), 0.8 * objective.cost(c.off));
}

TEST(AlignmentObjective, AResidualOfTheScaleCostsOneHalfAndAnotherFacingCostsOne) {
  const PyramidLevel target = level_of({{{0, 0, 0}}, {{0, 0, 1}}});
  const Isometry3d up(Eigen::Translation3d(0, 0, kScale));
  const Cloud opposite{{{0, 0, 0}}, {{0, 0, -1}}}, sideways{{{0, 0, 0}}, {{1, 0, 0}}};
  EXPECT_NEAR(AlignmentObjective(opposite, target, kScale, kGate).cost(up), 0.5, 1e-15);
  EXPECT_EQ(AlignmentObjective(sideways, target, kScale, kGate).cost(up), 1);
}

// Central differences over 1e-7 m: at that step no point of 1,500 should change its neighbour or pass a gate, where the
// cost jumps.
TEST(AlignmentObjective, GradientMeetsFiniteDifferences) {
  for (const std::uint64_t seed : {3u, 4u, 5u}) {
    const ObjectiveCase c = objective_case(seed);
    const AlignmentObjective objective(c.source, c.target, kScale, kGate);
    const Eigen::Vector3d centre(3, -2, 1);
    Twist gradient;
    EXPECT_EQ(objective.cost_and_gradient(c.off, centre, gradient), objective.cost(c.off));
    ASSERT_GT(gradient.norm(), 1e-2);
    constexpr double kStep = 1e-7;
    for (int k = 0; k < 6; ++k) {
      const Twist step = kStep * Twist::Unit(k);
      const double ahead = objective.cost(isometry_about(centre, step) * c.off);
      const double behind = objective.cost(isometry_about(centre, -step) * c.off);
      // Rounding of the cost, 1e-15 or so, over the step; the third derivative's share is far less.
      EXPECT_NEAR(gradient[k], (ahead - behind) / (2 * kStep), 1e-7) << "seed " << seed << ", parameter " << k;
    }
  }
}

TEST(AlignmentObjective, DoesNotChangeWhenBothCloudsMove) {
  const ObjectiveCase c = objective_case(6);
  Rng rng = make_stream(6, "alignment_objective_test motions");
  const Isometry3d A = testing::random_pose(30, rng), B = testing::random_pose(30, rng);
  const Cloud source = transformed(c.source, B);
  const PyramidLevel target = level_of(transformed(c.target.cloud, A));
  const double cost = AlignmentObjective(c.source, c.target, kScale, kGate).cost(c.off);
  ASSERT_GT(cost, 0.1);
  EXPECT_NEAR(AlignmentObjective(source, target, kScale, kGate).cost(A * c.off * B.inverse()), cost, 1e-12);
}

TEST(AlignmentObjective, RefusesAnEmptySourceAndLengthsThatAreNotPositive) {
  const ObjectiveCase c = objective_case(7);
  const Cloud empty;
  EXPECT_THROW(AlignmentObjective(empty, c.target, kScale, kGate), InvalidInput);
  EXPECT_THROW(AlignmentObjective(c.source, c.target, 0, kGate), InvalidOptions);
  EXPECT_THROW(AlignmentObjective(c.source, c.target, kScale, -1), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
