#include "tcm_icp/registration/joint_lp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/joint_scene.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/registration/l1_fit.hpp"

namespace tcm_icp {
namespace {

using testing::joint_scene;
using testing::JointScene;

JointScene scene(const testing::JointSceneOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "joint_lp_test");
  return joint_scene(options, rng);
}

double worst_error_m(const JointScene& s, const std::vector<Twist>& steps_m) {
  double worst = 0;
  for (std::size_t i = 0; i < steps_m.size(); ++i) worst = std::max(worst, (steps_m[i] - s.truth_m[i]).norm());
  return worst;
}

const std::vector<Twist> kStay(4, Twist::Zero());

TEST(JointLp, FindsExactSteps) {
  const JointScene s = scene({}, 1);
  constexpr double kTolerance_m = 1e-6;  // the tie-breaking noise
  ASSERT_GT(worst_error_m(s, kStay), 1e3 * kTolerance_m);
  const JointLpResult result = solve_joint_lp(s.frames, 0, s.links);
  ASSERT_EQ(result.status, LpStatus::kOptimal);
  EXPECT_LT(worst_error_m(s, result.steps_m), kTolerance_m);
  EXPECT_LT(result.objective_m, 1e-4 * result.initial_objective_m);
  EXPECT_LE(result.duality_gap, 1e-7);
  EXPECT_EQ(result.num_matches, 12U * 200U);
  EXPECT_GT(result.pivots, 0);
  EXPECT_TRUE(result.steps_m[0].isZero(0));
}

TEST(JointLp, ForTwoScansIsTheLineFitOfOne) {
  const JointScene s = scene({.num_scans = 2, .noise_m = 0.02}, 2);
  const JointLpResult joint = solve_joint_lp(s.frames, 0, s.links);
  Eigen::MatrixXd A(400, 6);
  Eigen::VectorXd d(400);
  Eigen::Index row = 0;
  for (const auto& link : s.links) {
    for (const auto& m : link.matches) {
      A.row(row) = (link.source == 1 ? 1 : -1) * residual_gradient(m, s.frames[1]).transpose();
      d[row++] = -residual_m(m);
    }
  }
  const L1FitResult fit = fit_l1(A, d);
  ASSERT_TRUE(joint.optimal() && fit.optimal());
  // `hold` and the tie-breaking choose a vertex next to the other at most.
  EXPECT_NEAR(joint.objective_m, fit.objective, 1e-4 * fit.objective);
  EXPECT_LT((joint.steps_m[1] - fit.x).norm(), 1e-3);
  EXPECT_LE(fit.objective, joint.objective_m + 1e-5);
}

TEST(JointLp, BothSolversAgree) {
  const JointScene s = scene({.num_scans = 3, .matches_per_link = 30, .noise_m = 0.02}, 3);
  JointLpOptions exact;
  exact.lp.solver = LpSolver::kCgal;
  const JointLpResult glpk = solve_joint_lp(s.frames, 0, s.links), cgal = solve_joint_lp(s.frames, 0, s.links, exact);
  ASSERT_TRUE(glpk.optimal() && cgal.optimal());
  EXPECT_NEAR(glpk.objective_m, cgal.objective_m, 1e-6 * glpk.objective_m);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((glpk.steps_m[i] - cgal.steps_m[i]).norm(), 1e-6);
}

TEST(JointLp, AWrongLinkDoesNotMoveTheScansAndIsNamed) {
  JointScene s = scene({.noise_m = 0.005}, 4);
  // Scans 1 and 2 contradict the others by 0.3 m, in both directions.
  for (auto& link : s.links) {
    if (std::min(link.target, link.source) != 1 || std::max(link.target, link.source) != 2) continue;
    for (auto& m : link.matches) m.target += (link.source == 1 ? 0.3 : -0.3) * m.normal.x() * m.normal;
  }
  // 400 matches a pair, sigma 5 mm: steps are known to a millimetre; a sixth of the rows being wrong costs some more.
  constexpr double kTolerance_m = 0.01;
  ASSERT_GT(worst_error_m(s, kStay), 10 * kTolerance_m);
  const JointLpResult result = solve_joint_lp(s.frames, 0, s.links);
  ASSERT_TRUE(result.optimal());
  EXPECT_LT(worst_error_m(s, result.steps_m), kTolerance_m);
  const auto outlying = outlying_links(result.link_medians_m, 0.005);
  ASSERT_EQ(outlying.size(), 2U);
  for (const std::size_t k : outlying) EXPECT_EQ(s.links[k].target + s.links[k].source, 3U);
}

TEST(JointLp, HoldsWhatNothingDetermines) {
  const JointScene s = scene({.noise_m = 0.01, .only_ground = true}, 5);
  const JointLpResult result = solve_joint_lp(s.frames, 0, s.links);
  ASSERT_TRUE(result.optimal());
  for (std::size_t i = 1; i < 4; ++i) {
    for (const int free : {2, 3, 4}) EXPECT_NEAR(result.steps_m[i][free], 0, 1e-9);
    for (const int held : {0, 1, 5}) EXPECT_NEAR(result.steps_m[i][held], s.truth_m[i][held], 0.01);
  }
}

TEST(JointLp, AScanWithoutLinksStaysAndSoDoesAnExactFit) {
  JointScene s = scene({}, 6);
  s.links.erase(
      std::remove_if(s.links.begin(), s.links.end(), [](const JointLink& l) { return l.target == 3 || l.source == 3; }),
      s.links.end());
  const JointLpResult result = solve_joint_lp(s.frames, 0, s.links);
  ASSERT_TRUE(result.optimal());
  EXPECT_TRUE(result.steps_m[3].isZero(1e-12));
  EXPECT_LT((result.steps_m[2] - s.truth_m[2]).norm(), 1e-6);
  const JointScene still = scene({.step_m = 0}, 6);
  EXPECT_LT(worst_error_m(still, solve_joint_lp(still.frames, 0, still.links).steps_m), 1e-12);
  const JointLpResult empty = solve_joint_lp(s.frames, 0, {});
  EXPECT_TRUE(empty.optimal());
  EXPECT_EQ(empty.pivots, 0);
}

TEST(JointLp, FollowsTheUnit) {
  const JointScene s = scene({.noise_m = 0.01}, 7);
  JointScene large = s;
  for (auto& frame : large.frames) frame = {1000 * frame.centre, 1000 * frame.radius_m};
  for (auto& link : large.links) {
    for (auto& m : link.matches) m = {1000 * m.source, 1000 * m.target, m.normal};
  }
  const JointLpResult a = solve_joint_lp(s.frames, 0, s.links), b = solve_joint_lp(large.frames, 0, large.links);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((1000 * a.steps_m[i] - b.steps_m[i]).norm(), 1e-5);
}

TEST(JointLp, RefusesWhatMakesNoSense) {
  JointScene s = scene({.matches_per_link = 5}, 8);
  EXPECT_THROW(solve_joint_lp(s.frames, 4, s.links), InvalidInput);
  EXPECT_THROW(solve_joint_lp(s.frames, 0, {{1, 1, {}}}), InvalidInput);
  EXPECT_THROW(solve_joint_lp(s.frames, 0, {{1, 9, {}}}), InvalidInput);
  s.links[0].matches[0].source.x() = std::nan("");
  EXPECT_THROW(solve_joint_lp(s.frames, 0, s.links), InvalidInput);
  JointLpOptions options;
  options.hold = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
}

TEST(OutlyingLinks, StandOutFromTheOthersAndFromTheNoise) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outlying_links({1, 1.1, 0.9, 5, nan, 1}, 0.5), std::vector<std::size_t>{3});
  EXPECT_TRUE(outlying_links({1, 1.1, 0.9, 5, nan, 1}, 6).empty()) << "within the noise";
  EXPECT_TRUE(outlying_links({1, 1, 9}, 0.5).empty()) << "three links cannot vote";
  EXPECT_TRUE(outlying_links({}, 0).empty());
}

}  // namespace
}  // namespace tcm_icp
