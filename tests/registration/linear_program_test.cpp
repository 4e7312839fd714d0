#include "tcm_icp/registration/linear_program.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <thread>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

LinearProgram program(const Eigen::MatrixXd& equations, const Eigen::VectorXd& rhs, const Eigen::VectorXd& objective,
                      double lower, double upper) {
  LinearProgram lp;
  lp.equations = equations.sparseView();
  lp.rhs = rhs;
  lp.objective = objective;
  lp.lower = Eigen::VectorXd::Constant(objective.size(), lower);
  lp.upper = Eigen::VectorXd::Constant(objective.size(), upper);
  return lp;
}

// Feasible by construction: the right-hand side comes from a point of the box.
LinearProgram random_program(Rng& rng, Eigen::Index num_rows, Eigen::Index num_columns) {
  const auto draw = [&rng] { return 2 * uniform01(rng) - 1; };
  const Eigen::MatrixXd equations = Eigen::MatrixXd::NullaryExpr(num_rows, num_columns, draw);
  const Eigen::VectorXd inside = Eigen::VectorXd::NullaryExpr(num_columns, draw);
  return program(equations, equations * inside, Eigen::VectorXd::NullaryExpr(num_columns, draw), -1, 1);
}

// The slow and obvious way for two equations: two variables are solved for, the others sit at either bound.
double best_vertex(const LinearProgram& lp) {
  const Eigen::MatrixXd E(lp.equations);
  const Eigen::Index n = E.cols();
  double best = -kInfinity;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i + 1; j < n; ++j) {
      for (int pattern = 0; pattern < (1 << n); ++pattern) {
        Eigen::VectorXd y(n);
        for (Eigen::Index k = 0; k < n; ++k) y[k] = (pattern >> k & 1) != 0 ? lp.upper[k] : lp.lower[k];
        y[i] = y[j] = 0;
        Eigen::Matrix2d basis;
        basis << E.col(i), E.col(j);
        const Eigen::Vector2d basic = basis.inverse() * (lp.rhs - E * y);
        y[i] = basic[0];
        y[j] = basic[1];
        const bool feasible = ((y - lp.lower).array() >= -1e-9).all() && ((lp.upper - y).array() >= -1e-9).all();
        if (feasible) best = std::max(best, lp.objective.dot(y));
      }
    }
  }
  return best;
}

class LinearProgramTest : public ::testing::TestWithParam<LpSolver> {
 protected:
  LinearProgramTest() { options_.solver = GetParam(); }
  LpOptions options_;
};

INSTANTIATE_TEST_SUITE_P(Solvers, LinearProgramTest, ::testing::Values(LpSolver::kGlpk, LpSolver::kCgal),
                         [](const auto& solver) { return std::string(to_string(solver.param)); });

TEST_P(LinearProgramTest, ReachesTheBestVertex) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng = make_stream(seed, "best vertex");
    const LinearProgram lp = random_program(rng, 2, 7);
    const LpSolution solution = solve(lp, options_);
    ASSERT_EQ(solution.status, LpStatus::kOptimal) << "seed " << seed;
    // 1e-9 is the simplex's tolerance for numbers near 1.
    EXPECT_NEAR(solution.objective, best_vertex(lp), 1e-8) << "seed " << seed;
    EXPECT_NEAR(solution.dual_objective, solution.objective, 1e-8) << "seed " << seed;
    EXPECT_LE(solution.primal_infeasibility, 1e-9) << "seed " << seed;
    EXPECT_GT(solution.pivots, 0) << "seed " << seed;
  }
}

TEST_P(LinearProgramTest, RowDualsAreTheChangeOfTheMaximumPerUnitOfRhs) {
  Rng rng = make_stream(5, "row duals");
  LinearProgram lp = random_program(rng, 3, 30);
  const LpSolution solution = solve(lp, options_);
  ASSERT_TRUE(solution.optimal());
  constexpr double kStep = 1e-5;  // small enough to stay in the same basis, where the maximum is linear
  for (Eigen::Index i = 0; i < 3; ++i) {
    LinearProgram moved = lp;
    moved.rhs[i] += kStep;
    const double slope = (solve(moved, options_).objective - solution.objective) / kStep;
    ASSERT_GT(std::abs(slope), 1e-3);
    EXPECT_NEAR(solution.row_duals[i], slope, 1e-6);
  }
}

TEST_P(LinearProgramTest, TakesFixedAndFreeVariables) {
  // y0 + y1 + y2 = 1 with y0 in [0, 2], y1 free and y2 fixed: y0 is worth more than y1, so it takes its upper bound.
  LinearProgram lp = program(Eigen::MatrixXd::Ones(1, 3), Eigen::VectorXd::Ones(1), Eigen::Vector3d(2, 1, 5), 0, 2);
  lp.lower[1] = -kInfinity;
  lp.upper[1] = kInfinity;
  lp.lower[2] = lp.upper[2] = 0.25;
  const LpSolution solution = solve(lp, options_);
  ASSERT_TRUE(solution.optimal());
  EXPECT_TRUE(solution.y.isApprox(Eigen::Vector3d(2, -1.25, 0.25), 1e-9)) << solution.y.transpose();
  EXPECT_NEAR(solution.row_duals[0], 1, 1e-9);
  EXPECT_LE(solution.duality_gap, 1e-9);
}

TEST_P(LinearProgramTest, CallsEquationsOutOfReachInfeasible) {
  const LinearProgram lp =
      program(Eigen::MatrixXd::Ones(1, 3), Eigen::VectorXd::Constant(1, 3.5), Eigen::Vector3d(1, 2, 3), -1, 1);
  const LpSolution solution = solve(lp, options_);
  EXPECT_EQ(solution.status, LpStatus::kInfeasible);
  EXPECT_EQ(solution.y.size(), 0);
  EXPECT_TRUE(std::isnan(solution.objective));
}

TEST_P(LinearProgramTest, CallsAnObjectiveWithoutMaximumUnbounded) {
  Eigen::MatrixXd equations(1, 2);
  equations << 1, -1;
  const LinearProgram lp = program(equations, Eigen::VectorXd::Zero(1), Eigen::Vector2d(1, 0), 0, kInfinity);
  EXPECT_EQ(solve(lp, options_).status, LpStatus::kUnbounded);
}

TEST_P(LinearProgramTest, CallsAnImpossibleProgramWithoutMaximumInfeasible) {
  Eigen::MatrixXd equations(1, 3);
  equations << 0, 1, 1;  // y1 + y2 = -1 with y >= 0, while y0 could grow for ever
  const LinearProgram lp = program(equations, -Eigen::VectorXd::Ones(1), Eigen::Vector3d(1, 0, 0), 0, kInfinity);
  EXPECT_EQ(solve(lp, options_).status, LpStatus::kInfeasible);
}

TEST_P(LinearProgramTest, StopsAtThePivotLimit) {
  Rng rng = make_stream(1, "pivot limit");
  const LinearProgram lp = random_program(rng, 6, 200);
  const LpSolution unlimited = solve(lp, options_);
  ASSERT_GT(unlimited.pivots, 3);
  options_.max_pivots = 3;
  const LpSolution solution = solve(lp, options_);
  EXPECT_EQ(solution.status, LpStatus::kIterationLimit);
  EXPECT_EQ(solution.pivots, 3);
  EXPECT_EQ(solution.y.size(), 0);
}

TEST_P(LinearProgramTest, WithoutColumnsOnlyZeroIsFeasible) {
  LinearProgram lp = program(Eigen::MatrixXd(2, 0), Eigen::Vector2d::Zero(), Eigen::VectorXd(), -1, 1);
  EXPECT_EQ(solve(lp, options_).status, LpStatus::kOptimal);
  lp.rhs[1] = 1;
  EXPECT_EQ(solve(lp, options_).status, LpStatus::kInfeasible);
}

TEST_P(LinearProgramTest, PrintsNothing) {
  Rng rng = make_stream(1, "silent");
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const LpSolution solution = solve(random_program(rng, 2, 7), options_);
  EXPECT_EQ(::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(solution.optimal());
}

TEST_P(LinearProgramTest, GivesTheSameBitsInThreadsAtOnce) {
  Rng rng = make_stream(2, "threads");
  const LinearProgram lp = random_program(rng, 6, 500);
  const LpSolution expected = solve(lp, options_);
  ASSERT_TRUE(expected.optimal());
  LpSolution solutions[2];
  const auto solve_often = [&](LpSolution& solution) {
    for (int i = 0; i < 10; ++i) solution = solve(lp, options_);
  };
  std::thread first(solve_often, std::ref(solutions[0]));
  std::thread second(solve_often, std::ref(solutions[1]));
  first.join();
  second.join();
  for (const LpSolution& solution : solutions) {
    EXPECT_EQ(solution.y, expected.y);
    EXPECT_EQ(solution.row_duals, expected.row_duals);
    EXPECT_EQ(solution.pivots, expected.pivots);
  }
}

TEST_P(LinearProgramTest, RefusesMalformedPrograms) {
  Rng rng = make_stream(4, "malformed");
  const LinearProgram good = random_program(rng, 2, 5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const auto& spoil) {
    LinearProgram lp = good;
    spoil(lp);
    EXPECT_THROW(solve(lp, options_), InvalidInput);
  };
  ASSERT_NO_THROW(solve(good, options_));
  refused([&](LinearProgram& lp) { lp.objective[1] = nan; });
  refused([&](LinearProgram& lp) { lp.rhs[0] = kInfinity; });
  refused([&](LinearProgram& lp) { lp.equations.coeffRef(1, 2) = nan; });
  refused([&](LinearProgram& lp) { lp.lower[3] = nan; });
  refused([&](LinearProgram& lp) { lp.lower[3] = 2; });
  refused([&](LinearProgram& lp) { lp.lower[3] = lp.upper[3] = kInfinity; });
  refused([&](LinearProgram& lp) { lp.upper.conservativeResize(4); });
  refused([&](LinearProgram& lp) { lp.equations.resize(0, 5), lp.rhs.resize(0); });
}

TEST(LinearProgram, CgalRefusesMoreColumnsThanItsLimit) {
  Rng rng = make_stream(1, "size limit");
  const LinearProgram lp = random_program(rng, 2, 20);
  LpOptions options;
  options.solver = LpSolver::kCgal;
  options.cgal_max_columns = 19;
  EXPECT_EQ(solve(lp, options).status, LpStatus::kSizeLimit);
  options.cgal_max_columns = 20;
  EXPECT_EQ(solve(lp, options).status, LpStatus::kOptimal);
}

TEST(LinearProgram, CertificateExposesWrongAnswers) {
  Rng rng = make_stream(6, "certificate");
  const LinearProgram lp = random_program(rng, 2, 10);
  const LpSolution solution = solve(lp);
  ASSERT_TRUE(solution.optimal());
  EXPECT_LT(certify(lp, solution.y, solution.row_duals).duality_gap, 1e-12);
  EXPECT_GT(certify(lp, solution.y, -solution.row_duals).duality_gap, 1e-3);
  EXPECT_GT(certify(lp, 0.9 * solution.y, solution.row_duals).primal_infeasibility, 1e-3);
  EXPECT_GT(certify(lp, 1.1 * solution.y, solution.row_duals).primal_infeasibility, 0.09);
  EXPECT_THROW(certify(lp, solution.row_duals, solution.y), InvalidInput);
}

TEST(LinearProgram, AnOptimumThatFailsItsCertificateIsAFailure) {
  Rng rng = make_stream(6, "strict certificate");
  const LinearProgram lp = random_program(rng, 6, 500);
  LpOptions options;
  options.max_certificate_error = std::numeric_limits<double>::denorm_min();  // no floating-point answer is that good
  EXPECT_EQ(solve(lp, options).status, LpStatus::kFailed);
}

TEST(LpOptions, NamesTheFieldOutOfBounds) {
  const auto message = [](const auto& spoil) -> std::string {
    LpOptions options;
    spoil(options);
    try {
      options.validate();
    } catch (const InvalidOptions& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([](LpOptions&) {}), "");
  EXPECT_NE(message([](LpOptions& o) { o.max_pivots = 0; }).find("max_pivots"), std::string::npos);
  EXPECT_NE(message([](LpOptions& o) { o.max_seconds = std::nan(""); }).find("max_seconds"), std::string::npos);
  EXPECT_NE(message([](LpOptions& o) { o.cgal_max_columns = 0; }).find("cgal_max_columns"), std::string::npos);
  EXPECT_NE(message([](LpOptions& o) { o.max_certificate_error = 0; }).find("max_certificate_error"),
            std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
