#include "visibility/sweep_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic_scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

Sweep truth() { return {Vector3d(0.1, -0.2, 0.3), Vector3d(0.1, 0.05, 1).normalized(), 0}; }

Vector3d random_direction(Rng& rng) { return testing::random_pose(1, rng).linear().col(0); }

// On planes in all directions: each piece along the line of the sweep, turned on its plane by noise [rad].
LinePieces pieces_of(const Sweep& sweep, std::size_t count, double noise, Rng& rng) {
  LinePieces pieces;
  while (pieces.middles.size() < count) {
    const Vector3d r = (0.3 + uniform01(rng)) * random_direction(rng), normal = random_direction(rng);
    const Vector3d to_cone = sweep.axis * r.squaredNorm() - r * sweep.axis.dot(r);
    const Vector3d row = normal.cross(to_cone);
    if (row.norm() < 0.3 * to_cone.norm()) continue;
    pieces.middles.push_back(sweep.centre + r);
    pieces.directions.push_back(Eigen::AngleAxisd(noise * standard_normal(rng), normal) * row.normalized());
    pieces.normals.push_back(normal);
  }
  return pieces;
}

TEST(SweepFit, ExactPiecesGiveCentreAndAxis) {
  Rng rng = make_stream(1, "sweep_fit_test exact");
  const LinePieces pieces = pieces_of(truth(), 500, 0, rng);
  for (std::size_t i = 0; i < 500; ++i) {
    const auto off = sweep_residual(truth(), pieces, i);
    ASSERT_TRUE(off);
    EXPECT_NEAR(*off, 0, 1e-12);
  }
  const Sweep start{truth().centre + Vector3d(0.1, 0.1, -0.1), Vector3d::UnitZ(), 0};
  EXPECT_LT(support_of_sweep(start, pieces, 0.02).share(), 0.5);
  const Sweep found = fit_sweep(start, pieces, 1, 0.2);
  EXPECT_LT((found.centre - truth().centre).norm(), 1e-6);
  EXPECT_NEAR(std::abs(found.axis.dot(truth().axis)), 1, 1e-9);
  EXPECT_LT(found.sigma, 1e-6);
}

// Slopes that were not those of what is fitted would draw the centre off, or aside of the minimum.
TEST(SweepFit, NoiseOfDirectionsDrawsNoWay) {
  Rng rng = make_stream(2, "sweep_fit_test noise");
  constexpr int kTrials = 40;
  Vector3d mean = Vector3d::Zero();
  double squares = 0, stated = 0;
  for (int k = 0; k < kTrials; ++k) {
    const Sweep found = fit_sweep(truth(), pieces_of(truth(), 300, 0.005, rng), 1, 0.2);
    mean += (found.centre - truth().centre) / kTrials;
    squares += (found.centre - truth().centre).squaredNorm() / kTrials;
    stated += found.sigma * found.sigma / kTrials;
  }
  EXPECT_LT(mean.norm(), 3 * std::sqrt(squares / kTrials)) << "noise, not bias";
  EXPECT_LT(squares, 3 * 2 * stated) << "three axes, none worse than sigma; twice for chance";
  EXPECT_GT(squares, stated / 4);
}

TEST(SweepFit, RowsThroughTheAxisCountForNothing) {
  Rng rng = make_stream(3, "sweep_fit_test columns");
  LinePieces pieces = pieces_of(truth(), 300, 0, rng);
  for (int k = 0; k < 100; ++k) {
    const Vector3d r = random_direction(rng), along = (r + 0.7 * truth().axis).normalized();
    pieces.middles.push_back(truth().centre + r);
    pieces.directions.push_back(along);
    pieces.normals.push_back(along.cross(random_direction(rng)).normalized());
  }
  const SweepSupport support = support_of_sweep(truth(), pieces, 1e-6);
  EXPECT_EQ(support.rows, 300u);
  EXPECT_EQ(support.others, 0u);
  EXPECT_EQ(support.share(), 1);
}

TEST(SweepFit, DirectionsByChanceSupportNothing) {
  Rng rng = make_stream(4, "sweep_fit_test chance");
  LinePieces pieces = pieces_of(truth(), 2000, 10, rng);
  EXPECT_LT(support_of_sweep(fit_sweep(truth(), pieces, 1, 0.2), pieces, 0.02).share(), 0.1);
  EXPECT_EQ(support_of_sweep(truth(), {}, 0.02).share(), 0);
}

TEST(SweepFit, AxisIsSeenFromTheCentre) {
  Rng rng = make_stream(5, "sweep_fit_test axis");
  const LinePieces pieces = pieces_of(truth(), 500, 0.02, rng);
  EXPECT_GT(std::abs(likely_axis(truth().centre, pieces).dot(truth().axis)), std::cos(0.02));
}

TEST(SweepFit, TooFewPiecesLeaveTheStart) {
  Rng rng = make_stream(6, "sweep_fit_test few");
  const Sweep start{Vector3d(0.3, 0, 0), Vector3d::UnitZ(), 0};
  EXPECT_EQ(fit_sweep(start, pieces_of(truth(), 4, 0, rng), 1, 0.2).centre, start.centre);
}

}  // namespace
}  // namespace tcm_icp
