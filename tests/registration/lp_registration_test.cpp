#include "tcm_icp/registration/lp_registration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::pose_rmse_m;
using testing::scaled_cloud;
using testing::scaled_pose;
using testing::SyntheticScene;
using testing::SyntheticSceneOptions;

constexpr double kStartAngle = 0.17;  // [rad] 10 degrees about a random axis
constexpr double kStartShift = 0.6;   // [m]

struct Case {
  SyntheticScene scene;
  Isometry3d truth, start;
};

// Two scans, turned by any angle about any axis against each other, and a rough guess.
Case make_case(const SyntheticSceneOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "lp_registration_test");
  Case c{testing::synthetic_scene(options, rng), {}, {}};
  c.truth = c.scene.T_target_source(0, 1);
  c.start = testing::perturbed(c.truth, c.scene.scans[1].points, kStartAngle, kStartShift, rng);
  return c;
}

// Gates from twice the start's error to somewhat above the spacing.
LpRegistrationOptions gates(double spacing_m) {
  LpRegistrationOptions options;
  options.initial_gate_m = 8 * spacing_m;
  options.final_gate_m = 1.5 * spacing_m;
  return options;
}

RegistrationResult run(const Case& c, double factor = 1, const LpSolver solver = LpSolver::kGlpk) {
  const ScanPyramid target(scaled_cloud(c.scene.scans[0], factor), c.scene.spacing_m / 2 * factor, 3);
  LpRegistrationOptions options = gates(c.scene.spacing_m * factor);
  options.lp.lp.solver = solver;
  return register_lp(scaled_cloud(c.scene.scans[1], factor), target, scaled_pose(c.start, factor), options);
}

// Some voxels on edges hold the mean of two surfaces, and tubes are round: the L1 fit passes over both, so what is left
// is the simplex' own rounding (1e-9) over the last, shrinking step.
constexpr double kExactTolerance = 1e-6;  // [m] in a scene of 24 m

TEST(RegisterLp, RecoversThePoseOfExactDataFromTenDegreesOff) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    const Case c = make_case({}, seed);
    const Points& points = c.scene.scans[1].points;
    ASSERT_GT(pose_rmse_m(c.truth, c.start, points), 1e5 * kExactTolerance);
    const RegistrationResult result = run(c);
    EXPECT_EQ(result.termination, Termination::kConverged) << to_string(result.termination);
    EXPECT_LE(pose_rmse_m(c.truth, result.T_target_source, points), kExactTolerance) << "seed " << seed;
    EXPECT_LE(result.lp.relative_duality_gap, 1e-7);
    EXPECT_EQ(result.lp.num_programs, result.num_iterations);
    EXPECT_TRUE(is_rigid(result.T_target_source.matrix(), 1e-12));
  }
}

TEST(RegisterLp, ErrorIsBelowTheNoiseOnNoisyData) {
  constexpr double kNoise = 0.02;  // [m]
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Case c = make_case({.noise_m = kNoise}, seed);
    ASSERT_GT(pose_rmse_m(c.truth, c.start, c.scene.scans[1].points), 10 * kNoise);
    EXPECT_LE(pose_rmse_m(c.truth, run(c).T_target_source, c.scene.scans[1].points), kNoise) << "seed " << seed;
  }
}

TEST(RegisterLp, FortyPercentOutliersOnBothSidesDoNotMatter) {
  constexpr double kNoise = 0.02;  // [m]
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Case c = make_case({.noise_m = kNoise, .outlier_share = 0.4}, seed);
    ASSERT_GT(pose_rmse_m(c.truth, c.start, c.scene.scans[1].points), 10 * kNoise);
    EXPECT_LE(pose_rmse_m(c.truth, run(c).T_target_source, c.scene.scans[1].points), kNoise) << "seed " << seed;
  }
}

// Matches that change and change back lead round in a circle of poses: without an end to it 5 of these take all 60
// steps.
TEST(RegisterLp, EndsWhereItComesBackToAPose) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Case c = make_case({.noise_m = 0.05}, seed);
    const ScanPyramid target(c.scene.scans[0], c.scene.spacing_m / 2, 3);
    LpRegistrationOptions options = gates(c.scene.spacing_m);
    options.convergence_share = 1e-6;
    const RegistrationResult result = register_lp(c.scene.scans[1], target, c.start, options);
    EXPECT_EQ(result.termination, Termination::kConverged) << "seed " << seed << ", " << result.num_iterations;
    EXPECT_LT(result.num_iterations, options.max_iterations);
  }
}

TEST(RegisterLp, UnitsDoNotMatter) {
  const Case c = make_case({.noise_m = 0.02}, 6);
  const RegistrationResult result = run(c);
  ASSERT_TRUE(result.usable());
  for (const double factor : {1000.0, 0.001}) {
    const RegistrationResult scaled = run(c, factor);
    EXPECT_EQ(scaled.num_iterations, result.num_iterations);
    // Programs are normalised before the solver sees them, so only rounding differs.
    EXPECT_LE(
        pose_rmse_m(result.T_target_source, scaled_pose(scaled.T_target_source, 1 / factor), c.scene.scans[1].points),
        1e-7)
        << "factor " << factor;
  }
}

TEST(RegisterLp, MovingEitherCloudMovesThePoseWithIt) {
  const Case c = make_case({}, 7);
  Rng rng = make_stream(7, "lp_registration_test motions");
  const Isometry3d A = testing::random_pose(50, rng), B = testing::random_pose(50, rng);
  Case moved = c;
  moved.scene.scans[0] = transformed(c.scene.scans[0], A);
  moved.scene.scans[1] = transformed(c.scene.scans[1], B);
  moved.start = A * c.start * B.inverse();
  const Points& points = moved.scene.scans[1].points;
  const Isometry3d expected = A * run(c).T_target_source * B.inverse();
  ASSERT_GT(pose_rmse_m(expected, moved.start, points), 1e5 * kExactTolerance);
  // The voxels fall elsewhere, so both are as near to the truth as exact data allows, and no nearer to each other.
  EXPECT_LE(pose_rmse_m(expected, run(moved).T_target_source, points), 2 * kExactTolerance);
}

TEST(RegisterLp, BothSolversGiveThePose) {
  const Case c = make_case({.points_per_scan = 700}, 8);
  const RegistrationResult glpk = run(c), cgal = run(c, 1, LpSolver::kCgal);
  ASSERT_TRUE(glpk.usable());
  ASSERT_GT(pose_rmse_m(c.start, glpk.T_target_source, c.scene.scans[1].points), 0.1);
  // 1e-6 of the spacing: CGAL is exact, GLPK rounds; a tie in the nearest neighbours cannot occur on random points.
  EXPECT_LE(pose_rmse_m(glpk.T_target_source, cgal.T_target_source, c.scene.scans[1].points), 1e-6 * c.scene.spacing_m);
}

TEST(RegisterLp, DoesNotSlideAlongParallelPlanes) {
  constexpr auto kShape = testing::SyntheticShape::kParallelPlanes;
  Rng rng = make_stream(9, "lp_registration_test");
  const SyntheticScene wide = testing::synthetic_scene({.shape = kShape, .num_scans = 1, .range_m = 30}, rng);
  const SyntheticScene narrow = testing::synthetic_scene({.shape = kShape, .num_scans = 1, .range_m = 4}, rng);
  // Upright, the directions nothing determines are x, y and the turn about z.
  const Cloud target = transformed(wide.scans[0], wide.T_world_scan[0]);
  const Cloud source = transformed(narrow.scans[0], narrow.T_world_scan[0]);
  Twist twist;
  twist << 0.01, -0.02, 0.1, 0.5, -0.7, 0.25;
  const Isometry3d start = isometry_from_twist(twist);
  const RegistrationResult result = register_lp(source, ScanPyramid(target, 0.2, 3), start, gates(wide.spacing_m));
  ASSERT_TRUE(result.T_target_source.matrix().allFinite());
  EXPECT_TRUE(result.usable()) << to_string(result.termination);
  Vector3d before = Vector3d::Zero(), after = Vector3d::Zero();
  double height_before = 0, height_after = 0;
  const double n = static_cast<double>(source.size());
  for (const auto& p : source.points) {
    before += start * p / n;
    after += result.T_target_source * p / n;
    height_before = std::max(height_before, std::abs((start * p - p).z()));
    height_after = std::max(height_after, std::abs((result.T_target_source * p - p).z()));
  }
  ASSERT_GT(height_before, 0.1);
  EXPECT_LE(height_after, 1e-6);
  // Straightening up by 22 mrad moves the middle by less than height times angle; a slide would be of the start's 0.9
  // m.
  EXPECT_LE((after - before).head<2>().norm(), 0.05);
}

TEST(RegisterLp, ScansOutOfReachAreTooFewCorrespondences) {
  const Case c = make_case({}, 10);
  const ScanPyramid target(c.scene.scans[0], 0.3, 3);
  const Isometry3d far = Eigen::Translation3d(1000, 0, 0) * c.start;
  const RegistrationResult result = register_lp(c.scene.scans[1], target, far, gates(c.scene.spacing_m));
  EXPECT_EQ(result.termination, Termination::kTooFewCorrespondences);
  EXPECT_FALSE(result.usable());
  EXPECT_EQ(result.num_correspondences, 0u);
  EXPECT_TRUE(result.T_target_source.isApprox(far, 0)) << "no guess is made";
}

TEST(RegisterLp, SameInputGivesTheSameBits) {
  const Case c = make_case({.noise_m = 0.02}, 11);
  EXPECT_TRUE(run(c).T_target_source.matrix() == run(c).T_target_source.matrix());
}

TEST(LpRegistrationOptions, RejectEachFieldOutOfRangeByName) {
  const auto message = [](auto change) {
    LpRegistrationOptions options = gates(0.3);
    options.validate();
    change(options);
    try {
      options.validate();
    } catch (const InvalidOptions& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  using O = LpRegistrationOptions;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto has = [](const std::string& text, const char* name) { return text.find(name) != std::string::npos; };
  EXPECT_TRUE(has(message([](O& o) { o.initial_gate_m = 0; }), "initial_gate_m"));
  EXPECT_TRUE(has(message([](O& o) { o.initial_gate_m = kNan; }), "initial_gate_m"));
  EXPECT_TRUE(has(message([](O& o) { o.final_gate_m = 2 * o.initial_gate_m; }), "final_gate_m"));
  EXPECT_TRUE(has(message([](O& o) { o.gate_shrink = 1; }), "gate_shrink"));
  EXPECT_TRUE(has(message([](O& o) { o.initial_normal_angle_deg = 91; }), "initial_normal_angle_deg"));
  EXPECT_TRUE(has(message([](O& o) { o.final_normal_angle_deg = 0; }), "final_normal_angle_deg"));
  EXPECT_TRUE(has(message([](O& o) { o.max_iterations = 0; }), "max_iterations"));
  EXPECT_TRUE(has(message([](O& o) { o.convergence_share = -1; }), "convergence_share"));
  EXPECT_TRUE(has(message([](O& o) { o.min_correspondences = 5; }), "min_correspondences"));
  EXPECT_TRUE(has(message([](O& o) { o.lp.tie_breaking = 1; }), "tie_breaking"));
}

TEST(LpRegistration, MatchesThatAreTakenOutAreNotFittedTo) {
  const Case c = make_case({}, 3);
  const Cloud& source = c.scene.scans[1];
  const ScanPyramid target(c.scene.scans[0], c.scene.spacing_m / 2, 3);
  const LpRegistrationOptions options = gates(c.scene.spacing_m);
  std::size_t num_asked = 0;
  const auto none = [&](const Isometry3d& T_target_source, Correspondences& matches) {
    EXPECT_TRUE(T_target_source.isApprox(c.start));
    EXPECT_GT(matches.size(), 100u);
    matches.clear();
    ++num_asked;
  };
  const RegistrationResult stopped = register_lp(source, target, c.start, options, none);
  EXPECT_EQ(stopped.termination, Termination::kTooFewCorrespondences);
  EXPECT_EQ(num_asked, 1u);
  const auto all = [&](const Isometry3d&, Correspondences&) { ++num_asked; };
  const RegistrationResult asked = register_lp(source, target, c.start, options, all),
                           plain = register_lp(source, target, c.start, options);
  EXPECT_GT(num_asked, 2u);
  EXPECT_TRUE(asked.T_target_source.matrix() == plain.T_target_source.matrix());
}

}  // namespace
}  // namespace tcm_icp
