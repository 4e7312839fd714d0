#include "tcm_icp/registration/paper_registration.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Points moved(const Points& points, const Isometry3d& T) { return transformed({points, {}}, T).points; }

// min sum |P' - (R P + T)|_1 as one program of 12 unknowns, straight from the paper.
double objective_of_twelve_unknowns(const Points& source, const Points& target) {
  const auto n = static_cast<Eigen::Index>(source.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * n, 12);
  Eigen::VectorXd d(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      A.row(3 * i + axis).segment<3>(4 * axis) = source[static_cast<std::size_t>(i)].transpose();
      A(3 * i + axis, 4 * axis + 3) = 1;
      d[3 * i + axis] = target[static_cast<std::size_t>(i)][axis];
    }
  }
  return fit_l1(A, d).objective;
}

TEST(PaperSimplexStep, ExactCorrespondencesGiveTheMotionWhateverTheRotation) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    Rng rng = make_stream(seed, "paper_registration_test");
    const Points source = testing::random_points(80, 10, rng);
    const Isometry3d truth = testing::random_pose(20, rng);
    ASSERT_GT(rotation_angle_rad(truth.linear()), 0.5);
    Isometry3d T = Isometry3d::Identity();
    LpFigures figures;
    ASSERT_EQ(paper_simplex_step(source, moved(source, truth), {}, T, figures), Termination::kConverged);
    // Noise against ties: 1e-6 of the median coordinate, some 10 m, on each right-hand side.
    EXPECT_TRUE(testing::is_pose_near(truth, T, 1e-5, 5e-5));
    EXPECT_EQ(figures.num_programs, 3);
    EXPECT_LE(figures.relative_duality_gap, 1e-7);
  }
}

TEST(PaperSimplexStep, AThirdOfWrongCorrespondencesDoesNotMatter) {
  Rng rng = make_stream(5, "paper_registration_test");
  const Points source = testing::random_points(90, 10, rng);
  const Isometry3d truth = testing::random_pose(20, rng);
  Points target = moved(source, truth);
  for (std::size_t i = 0; i < target.size(); i += 3) target[i] += testing::random_pose(30, rng).translation();
  Isometry3d T = Isometry3d::Identity();
  LpFigures figures;
  ASSERT_EQ(paper_simplex_step(source, target, {}, T, figures), Termination::kConverged);
  EXPECT_TRUE(testing::is_pose_near(truth, T, 1e-5, 5e-5));
}

TEST(PaperSimplexStep, ThreeProgramsOfFourUnknownsHaveTheOptimumOfOneOfTwelve) {
  Rng rng = make_stream(6, "paper_registration_test");
  const Points source = testing::random_points(40, 10, rng);
  Points target = moved(source, testing::random_pose(5, rng));
  for (auto& p : target) p += testing::random_pose(1, rng).translation();
  Isometry3d T = Isometry3d::Identity();
  LpFigures figures;
  ASSERT_EQ(paper_simplex_step(source, target, {}, T, figures), Termination::kConverged);
  const double expected = objective_of_twelve_unknowns(source, target);
  ASSERT_GT(expected, 10);
  // Each side's noise against ties moves its optimum by up to 2e-6 median|d| a row (l1_fit.hpp): 120 rows, below 5 m.
  EXPECT_NEAR(figures.objective, expected, 2 * 2e-6 * 120 * 5);
}

TEST(PaperSimplexStep, ALinearMapThatIsNoRotationIsProjectedOntoTheNearestOne) {
  Rng rng = make_stream(7, "paper_registration_test");
  const Points source = testing::random_points(60, 10, rng);
  const Isometry3d truth = testing::random_pose(5, rng);
  Eigen::Matrix3d linear = truth.linear();
  for (double& entry : linear.reshaped()) entry += 0.1 * standard_normal(rng);
  ASSERT_GT((linear * linear.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.1);
  Points target;
  for (const auto& p : source) target.push_back(linear * p + truth.translation());
  Isometry3d T = Isometry3d::Identity();
  LpFigures figures;
  ASSERT_EQ(paper_simplex_step(source, target, {}, T, figures), Termination::kConverged);
  EXPECT_TRUE(is_rigid(T.matrix(), 1e-12));
  EXPECT_TRUE(testing::is_near(project_onto_so3(linear), T.linear(), 1e-5));
}

TEST(PaperSimplexStep, AFlatScanTurnsInsteadOfBlowingUp) {
  Rng rng = make_stream(10, "paper_registration_test");
  Points source = testing::random_points(60, 10, rng);
  for (auto& p : source) p.z() = 1e-15 * standard_normal(rng);  // flat but for rounding
  const Isometry3d truth = testing::random_pose(5, rng);
  Isometry3d T = Isometry3d::Identity();
  LpFigures figures;
  ASSERT_EQ(paper_simplex_step(source, moved(source, truth), {}, T, figures), Termination::kConverged);
  // The turn that lays the plane into the other; a rotation leaves the third column no choice.
  EXPECT_TRUE(testing::is_pose_near(truth, T, 1e-5, 5e-5));
}

TEST(PaperSimplexStep, ThreePointsAreTooFewAndUnequalNumbersAreRefused) {
  const Points three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Isometry3d T = Isometry3d::Identity();
  LpFigures figures;
  EXPECT_EQ(paper_simplex_step(three, three, {}, T, figures), Termination::kTooFewCorrespondences);
  EXPECT_EQ(paper_simplex_step({}, {}, {}, T, figures), Termination::kTooFewCorrespondences);
  EXPECT_EQ(figures.num_programs, 0);
  EXPECT_THROW(paper_simplex_step(three, {}, {}, T, figures), InvalidInput);
}

TEST(RegisterPaper, ConvergesFromANearbyStartOnTheSamePoints) {
  Rng rng = make_stream(8, "paper_registration_test");
  const testing::SyntheticScene scene = testing::synthetic_scene({.num_scans = 1, .points_per_scan = 800}, rng);
  const Points& source = scene.scans[0].points;
  const Isometry3d truth = testing::random_pose(20, rng);
  const Points target = moved(source, truth);
  // Starts within about half the spacing, as the paper's nearest neighbours have no gate and no normals.
  const Isometry3d start = testing::perturbed(truth, source, 0.02, 0.3, rng);
  constexpr double kTolerance = 1e-3;  // [m] a thousandth of the spacing; the noise against ties is a hundredth of it
  ASSERT_GT(testing::pose_rmse_m(truth, start, source), 100 * kTolerance);
  const RegistrationResult result = register_paper(source, target, NeighborIndex(target), start, {});
  EXPECT_EQ(result.termination, Termination::kConverged) << to_string(result.termination);
  EXPECT_LE(testing::pose_rmse_m(truth, result.T_target_source, source), kTolerance);
  EXPECT_EQ(result.num_correspondences, source.size());
}

// Half of the target is missing, so that half of the source has no counterpart.
struct HalfSeen {
  Points source, target;
  Isometry3d truth, start;
};

HalfSeen half_seen(std::uint64_t seed) {
  Rng rng = make_stream(seed, "paper_registration_test half");
  HalfSeen s;
  s.source = testing::synthetic_scene({.num_scans = 1, .points_per_scan = 1500}, rng).scans[0].points;
  s.truth = testing::random_pose(5, rng);
  for (const auto& p : s.source) {
    if (p.x() + 0.3 * p.y() > 0) s.target.push_back(s.truth * p);
  }
  s.start = testing::perturbed(s.truth, s.source, 0.03, 0.3, rng);
  return s;
}

TEST(RegisterPaper, PointsWithoutCounterpartPullUnlessTheReadingLeavesThemOut) {
  const HalfSeen s = half_seen(11);
  const NeighborIndex index(s.target);
  const auto error_with = [&](const PaperRegistrationOptions& options) {
    const RegistrationResult result = register_paper(s.source, s.target, index, s.start, options);
    EXPECT_TRUE(result.usable()) << to_string(result.termination);
    return testing::pose_rmse_m(s.truth, result.T_target_source, s.source);
  };
  PaperRegistrationOptions all, near, mutual, half, small_motion;
  all.reading = near.reading = mutual.reading = half.reading =
      PaperOptions{.matches = PaperMatches::kNearest, .kept_share = 1, .max_rounds = 60, .end = PaperEnd::kMotion};
  near.reading.matches = PaperMatches::kThreshold;
  near.threshold_m = 1;
  mutual.reading.matches = PaperMatches::kMutual;
  half.reading.kept_share = 0.4;
  small_motion = half;
  small_motion.reading.unknowns = PaperUnknowns::kTwist;
  const double with_all = error_with(all);
  EXPECT_GT(with_all, 0.2);
  for (const auto& better : {near, mutual, half, small_motion}) EXPECT_LT(error_with(better), with_all / 4);
}

TEST(RegisterPaper, TheSlackNeverRisesWhereItEndsTheRounds) {
  const HalfSeen s = half_seen(12);
  const NeighborIndex index(s.target);
  PaperRegistrationOptions options;
  options.reading.end = PaperEnd::kSlack;
  double last = std::numeric_limits<double>::infinity();
  for (const int rounds : {1, 2, 4, 8, 100}) {
    options.reading.max_rounds = rounds;
    const RegistrationResult result = register_paper(s.source, s.target, index, s.start, options);
    const PaperMatchedPoints matches =
        paper_matches(s.source, NeighborIndex(s.source), s.target, index, result.T_target_source, options);
    const double slack = std::accumulate(matches.distances.begin(), matches.distances.end(), 0.0);
    EXPECT_LE(slack, last) << rounds << " rounds";
    last = slack;
  }
}

TEST(PaperMatches, KeepsTheNearestInTheOrderOfThePoints) {
  const Points source{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, target{{0, 0, 0.3}, {1, 0, 0.1}, {2, 0, 0.2}};
  const NeighborIndex source_index(source), target_index(target);
  PaperRegistrationOptions options;
  options.reading = {.matches = PaperMatches::kNearest, .kept_share = 0.5};
  const auto half = paper_matches(source, source_index, target, target_index, Isometry3d::Identity(), options);
  ASSERT_EQ(half.source.size(), 2u);
  EXPECT_EQ(half.source[0], source[1]);
  EXPECT_EQ(half.source[1], source[2]);
  EXPECT_NEAR(half.distances[1], 0.2, 1e-12);
  options.reading = {.matches = PaperMatches::kMutual, .kept_share = 1};
  const auto mutual = paper_matches(source, source_index, target, target_index, Isometry3d::Identity(), options);
  EXPECT_EQ(mutual.source, (Points{source[0], source[1], source[2]}));  // the last one's neighbour has a nearer one
  options.reading.matches = PaperMatches::kThreshold;
  options.threshold_m = 0.25;
  const auto near = paper_matches(source, source_index, target, target_index, Isometry3d::Identity(), options);
  EXPECT_EQ(near.source, (Points{source[1], source[2]}));
}

TEST(PaperSimplexStep, OneSidedSlackLeavesNoPointOnTheOtherSide) {
  Rng rng = make_stream(13, "paper_registration_test");
  const Points source = testing::random_points(60, 10, rng);
  const Isometry3d truth = testing::random_pose(5, rng);
  Points target = moved(source, truth);
  for (auto& p : target) p += 0.1 * Vector3d(standard_normal(rng), standard_normal(rng), standard_normal(rng));
  const auto residuals = [&](PaperSlack slack) {
    Isometry3d T = Isometry3d::Identity();
    LpFigures figures;
    EXPECT_EQ(paper_simplex_step(source, target, {}, T, figures, slack), Termination::kConverged);
    EXPECT_TRUE(is_rigid(T.matrix(), 1e-12));
    Eigen::Matrix3Xd out(3, 60);
    for (Eigen::Index i = 0; i < 60; ++i) {
      out.col(i) = T * source[static_cast<std::size_t>(i)] - target[static_cast<std::size_t>(i)];
    }
    return out;
  };
  EXPECT_GE(residuals(PaperSlack::kAbove).minCoeff(), -1e-9);
  EXPECT_LE(residuals(PaperSlack::kBelow).maxCoeff(), 1e-9);
  const double both = residuals(PaperSlack::kBoth).cwiseAbs().mean();
  EXPECT_LT(both, residuals(PaperSlack::kBetween).cwiseAbs().mean());
  EXPECT_LT(residuals(PaperSlack::kBetween).cwiseAbs().mean(), residuals(PaperSlack::kAbove).cwiseAbs().mean());
}

TEST(RegisterPaper, NothingToMatchIsTooFewCorrespondences) {
  Rng rng = make_stream(9, "paper_registration_test");
  const Points points = testing::random_points(10, 1, rng);
  const NeighborIndex index(points), none(Points{});
  EXPECT_EQ(register_paper({}, points, index, Isometry3d::Identity(), {}).termination,
            Termination::kTooFewCorrespondences);
  EXPECT_EQ(register_paper(points, {}, none, Isometry3d::Identity(), {}).termination,
            Termination::kTooFewCorrespondences);
}

TEST(PaperRegistrationOptions, RejectValuesOutOfRange) {
  EXPECT_NO_THROW(PaperRegistrationOptions().validate());
  PaperRegistrationOptions no_rounds, no_end, no_threshold, none_kept, too_many_kept, no_change, sided_twist;
  no_rounds.reading.max_rounds = 0;
  no_end.convergence_share = 0;
  no_threshold.threshold_m = -1;
  none_kept.reading.kept_share = 0;
  too_many_kept.reading.kept_share = 1.01;
  no_change.reading.marginal_share = 0;
  sided_twist.reading.unknowns = PaperUnknowns::kTwist;
  sided_twist.reading.slack = PaperSlack::kAbove;
  for (const auto& bad : {no_rounds, no_end, no_threshold, none_kept, too_many_kept, no_change, sided_twist}) {
    EXPECT_THROW(bad.validate(), InvalidOptions);
  }
}

}  // namespace
}  // namespace tcm_icp
