#include "tcm_icp/registration/l1_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

struct Rows {
  Eigen::MatrixXd A;
  Eigen::VectorXd d;
};

// Linearised point-to-plane rows [p x n, n] of a room with ground, two walls and clutter; d = A twist + noise, and one
// row in ten is a gross outlier. `grid` puts the points on whole metres.
Rows room(Rng& rng, Eigen::Index num_rows, const Eigen::VectorXd& twist, double noise_m, bool grid = false) {
  Rows rows{Eigen::MatrixXd(num_rows, 6), Eigen::VectorXd(num_rows)};
  const Eigen::Vector3d axes[3] = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  for (Eigen::Index i = 0; i < num_rows; ++i) {
    const std::uint64_t kind = uniform_index(rng, 4);
    Eigen::Vector3d p(40 * uniform01(rng) - 20, 40 * uniform01(rng) - 20, 8 * uniform01(rng) - 2);
    Eigen::Vector3d n(standard_normal(rng), standard_normal(rng), standard_normal(rng));
    if (grid) p = p.array().round();
    n = kind < 3 ? axes[kind] : n.normalized();
    rows.A.row(i) << p.cross(n).transpose(), n.transpose();
    rows.d[i] = rows.A.row(i).dot(twist) + noise_m * standard_normal(rng);
    if (uniform01(rng) < 0.1) rows.d[i] += 4 * uniform01(rng) - 2;
  }
  return rows;
}

Eigen::VectorXd example_twist() {
  Eigen::VectorXd twist(6);
  twist << 0.02, -0.01, 0.03, 0.2, -0.1, 0.05;
  return twist;
}

Rows random_rows(Rng& rng, Eigen::Index num_rows, Eigen::Index num_unknowns) {
  const auto draw = [&rng] { return 2 * uniform01(rng) - 1; };
  return {Eigen::MatrixXd::NullaryExpr(num_rows, num_unknowns, draw), Eigen::VectorXd::NullaryExpr(num_rows, draw)};
}

double l1(const Rows& rows, const Eigen::VectorXd& x) { return (rows.A * x - rows.d).lpNorm<1>(); }

// The slow and obvious way: some minimiser fits n of the rows exactly.
double least_over_subsets(const Rows& rows) {
  const Eigen::Index n = rows.A.cols();
  double best = std::numeric_limits<double>::infinity();
  std::vector<bool> chosen(static_cast<std::size_t>(rows.A.rows()), false);
  std::fill(chosen.end() - n, chosen.end(), true);
  do {
    std::vector<Eigen::Index> subset;
    for (Eigen::Index i = 0; i < rows.A.rows(); ++i) {
      if (chosen[static_cast<std::size_t>(i)]) subset.push_back(i);
    }
    best = std::min(best, l1(rows, rows.A(subset, Eigen::all).fullPivLu().solve(rows.d(subset))));
  } while (std::next_permutation(chosen.begin(), chosen.end()));
  return best;
}

class L1FitTest : public ::testing::TestWithParam<LpSolver> {
 protected:
  L1FitTest() { options_.lp.solver = GetParam(); }
  L1FitOptions options_;
};

INSTANTIATE_TEST_SUITE_P(Solvers, L1FitTest, ::testing::Values(LpSolver::kGlpk, LpSolver::kCgal),
                         [](const auto& solver) { return std::string(to_string(solver.param)); });

TEST_P(L1FitTest, EqualsTheBestOfAllSubsets) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng = make_stream(seed, "subsets");
    const Rows rows = random_rows(rng, 10, 3);
    const double expected = least_over_subsets(rows);
    options_.tie_breaking = 0;
    EXPECT_NEAR(fit_l1(rows.A, rows.d, options_).objective, expected, 1e-8 * expected) << "seed " << seed;
    // With noise of 1e-6 on ten numbers below 1, the optimum moves by 2e-5 at most.
    options_.tie_breaking = 1e-6;
    const L1FitResult noisy = fit_l1(rows.A, rows.d, options_);
    ASSERT_TRUE(noisy.optimal());
    EXPECT_NEAR(noisy.objective, expected, 2e-5) << "seed " << seed;
    EXPECT_NEAR(noisy.objective, l1(rows, noisy.x), 1e-12);
    EXPECT_EQ(noisy.rank, 3);
  }
}

TEST_P(L1FitTest, InOneDimensionIsTheMedian) {
  Rng rng = make_stream(1, "median");
  std::vector<double> values;
  for (int i = 0; i < 101; ++i) values.push_back(std::exp(3 * standard_normal(rng)));
  const Eigen::VectorXd d = Eigen::VectorXd::Map(values.data(), 101);
  std::sort(values.begin(), values.end());
  const L1FitResult result = fit_l1(Eigen::MatrixXd::Ones(101, 1), d, options_);
  EXPECT_NEAR(result.x[0], values[50], 2e-6 * values[50]);  // tie-breaking noise, in units of this very median
}

TEST_P(L1FitTest, InOneDimensionIsTheWeightedMedian) {
  const Eigen::VectorXd d = Eigen::Vector4d(1, 2, 3, 10);
  const Eigen::VectorXd weights = Eigen::Vector4d(1, 2, 1, 7);  // 10 alone outweighs the others
  const L1FitResult result = fit_l1(Eigen::MatrixXd::Ones(4, 1), d, options_, weights);
  EXPECT_NEAR(result.x[0], 10, 1e-5);
  EXPECT_NEAR(result.objective, 9 + 2 * 8 + 7, 1e-4);
  EXPECT_NEAR(fit_l1(Eigen::MatrixXd::Ones(4, 1), d, options_, Eigen::Vector4d(1, 2, 0.5, 0)).x[0], 2, 1e-5);
}

TEST_P(L1FitTest, ShrugsOffGrossOutliers) {
  Rng rng = make_stream(2, "outliers");
  const Eigen::VectorXd twist = example_twist();
  const Rows rows = room(rng, 1'000, twist, 0.005);
  // The median of N = 900 good rows with sigma = 5 mm is known to about 5 mm sqrt(pi/2) sqrt(6/900) = 0.5 mm; 6 times
  // that.
  constexpr double kTolerance = 3e-3;
  const Eigen::VectorXd least_squares = rows.A.colPivHouseholderQr().solve(rows.d);
  ASSERT_GT((least_squares - twist).norm(), 3 * kTolerance);
  ASSERT_GT(twist.norm(), 10 * kTolerance);
  const L1FitResult result = fit_l1(rows.A, rows.d, options_);
  ASSERT_TRUE(result.optimal());
  EXPECT_LT((result.x - twist).norm(), kTolerance);
  EXPECT_LE(result.objective, l1(rows, twist));
}

TEST_P(L1FitTest, ScalesWithTheDataAndWithTheColumns) {
  Rng rng = make_stream(3, "scale");
  const Rows rows = room(rng, 500, example_twist(), 0.01);
  const L1FitResult expected = fit_l1(rows.A, rows.d, options_);
  ASSERT_TRUE(expected.optimal());
  for (const double scale : {1e-3, 1e3}) {
    const L1FitResult larger = fit_l1(rows.A, scale * rows.d, options_);
    EXPECT_LT((larger.x - scale * expected.x).norm(), 1e-9 * larger.x.norm());
    // Lengths scale, angles do not: three columns and d grow.
    Eigen::MatrixXd A = rows.A;
    A.leftCols(3) *= scale;
    const L1FitResult scene = fit_l1(A, scale * rows.d, options_);
    EXPECT_LT((scene.x.head(3) - expected.x.head(3)).norm(), 1e-9 * expected.x.norm());
    EXPECT_LT((scene.x.tail(3) - scale * expected.x.tail(3)).norm(), 1e-9 * scale * expected.x.norm());
  }
}

TEST_P(L1FitTest, WeightsCountLikeRepeatedRows) {
  Rng rng = make_stream(4, "weights");
  const Rows rows = random_rows(rng, 30, 3);
  Eigen::VectorXd weights(30);
  std::vector<Eigen::Index> repeated;
  for (Eigen::Index i = 0; i < 30; ++i) {
    weights[i] = static_cast<double>(uniform_index(rng, 4));
    repeated.insert(repeated.end(), static_cast<std::size_t>(weights[i]), i);
  }
  const L1FitResult weighted = fit_l1(rows.A, rows.d, options_, weights);
  const L1FitResult plain = fit_l1(rows.A(repeated, Eigen::all), rows.d(repeated), options_);
  ASSERT_TRUE(weighted.optimal());
  ASSERT_GT(std::abs(fit_l1(rows.A, rows.d, options_).objective - plain.objective), 1);
  EXPECT_NEAR(weighted.objective, plain.objective, 1e-4);  // two draws of the tie-breaking noise on 50 rows below 1
}

TEST_P(L1FitTest, LeavesUndeterminedDirectionsAtZero) {
  // Ground alone: normals along z say nothing of x and y shifts and of the turn about z.
  Rng rng = make_stream(5, "ground");
  Rows rows = random_rows(rng, 200, 6);
  for (const Eigen::Index column : {2, 3, 4}) rows.A.col(column).setZero();
  Eigen::VectorXd twist = example_twist();
  rows.d = rows.A * twist;
  const L1FitResult result = fit_l1(rows.A, rows.d, options_);
  ASSERT_TRUE(result.optimal());
  EXPECT_EQ(result.rank, 3);
  for (const Eigen::Index column : {2, 3, 4}) {
    EXPECT_NEAR(result.x[column], 0, 1e-12);
    twist[column] = 0;
  }
  EXPECT_LT((result.x - twist).norm(), 1e-5);  // tie-breaking noise
}

TEST_P(L1FitTest, SharesBetweenColumnsThatAreMultiples) {
  Rng rng = make_stream(6, "multiples");
  Rows rows = random_rows(rng, 100, 3);
  rows.A.col(2) = 100 * rows.A.col(0);
  rows.d = 8 * rows.A.col(0) + rows.A.col(1);
  const L1FitResult result = fit_l1(rows.A, rows.d, options_);
  ASSERT_TRUE(result.optimal());
  EXPECT_EQ(result.rank, 2);
  // In scaled columns both carry the same half.
  EXPECT_TRUE(result.x.isApprox(Eigen::Vector3d(4, 1, 0.04), 1e-4)) << result.x.transpose();
}

TEST_P(L1FitTest, FewerRowsThanUnknownsFitExactly) {
  Rng rng = make_stream(7, "few rows");
  const Rows rows = random_rows(rng, 2, 6);
  ASSERT_GT(rows.d.lpNorm<1>(), 0.1);
  const L1FitResult result = fit_l1(rows.A, rows.d, options_);
  ASSERT_TRUE(result.optimal());
  EXPECT_EQ(result.rank, 2);
  EXPECT_LT(result.objective, 1e-5);
  EXPECT_LT(result.x.norm(), 10);
}

TEST_P(L1FitTest, WithNothingToFitIsZero) {
  const auto is_zero = [this](const Eigen::MatrixXd& A, const Eigen::VectorXd& d, int rank, double objective) {
    const L1FitResult result = fit_l1(A, d, options_);
    EXPECT_TRUE(result.optimal());
    EXPECT_EQ(result.x, Eigen::VectorXd::Zero(A.cols()));
    EXPECT_EQ(result.rank, rank);
    EXPECT_EQ(result.objective, objective);
  };
  is_zero(Eigen::MatrixXd(0, 6), Eigen::VectorXd(0), 0, 0);
  is_zero(Eigen::MatrixXd::Zero(5, 2), Eigen::VectorXd::Ones(5), 0, 5);
  is_zero(Eigen::MatrixXd::Ones(5, 1), Eigen::VectorXd::Zero(5), 1, 0);
}

TEST_P(L1FitTest, WithoutAnOptimumHasNoX) {
  Rng rng = make_stream(8, "limit");
  const Rows rows = random_rows(rng, 300, 6);
  options_.lp.max_pivots = 2;
  const L1FitResult result = fit_l1(rows.A, rows.d, options_);
  EXPECT_EQ(result.status, LpStatus::kIterationLimit);
  EXPECT_EQ(result.x.size(), 6);
  EXPECT_TRUE(result.x.array().isNaN().all());
  EXPECT_TRUE(std::isnan(result.objective));
}

TEST_P(L1FitTest, FitsCleanGridsWithoutCycling) {
  Rng rng = make_stream(9, "grid");
  const Rows rows = room(rng, 500, example_twist(), 0, true);
  const L1FitResult result = fit_l1(rows.A, rows.d, options_);
  ASSERT_TRUE(result.optimal());
  EXPECT_LT((result.x - example_twist()).norm(), 1e-5);
}

TEST_P(L1FitTest, GivesTheSameBitsInThreadsAtOnce) {
  Rng rng = make_stream(10, "threads");
  const Rows rows = room(rng, 1'000, example_twist(), 0.01);
  const L1FitResult expected = fit_l1(rows.A, rows.d, options_);
  ASSERT_TRUE(expected.optimal());
  Eigen::VectorXd x[2];
  std::thread first([&] { x[0] = fit_l1(rows.A, rows.d, options_).x; });
  std::thread second([&] { x[1] = fit_l1(rows.A, rows.d, options_).x; });
  first.join();
  second.join();
  EXPECT_EQ(x[0], expected.x);
  EXPECT_EQ(x[1], expected.x);
}

TEST_P(L1FitTest, RefusesInputThatCannotBeFitted) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Ones(3, 2);
  const Eigen::VectorXd d = Eigen::Vector3d(1, 2, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ASSERT_NO_THROW(fit_l1(A, d, options_, Eigen::Vector3d(1, 0, 2)));
  EXPECT_THROW(fit_l1(nan * A, d, options_), InvalidInput);
  EXPECT_THROW(fit_l1(A, nan * d, options_), InvalidInput);
  EXPECT_THROW(fit_l1(A, d, options_, Eigen::Vector3d(1, nan, 1)), InvalidInput);
  EXPECT_THROW(fit_l1(A, d, options_, Eigen::Vector3d(1, -1, 1)), InvalidInput);
  EXPECT_THROW(fit_l1(A, d, options_, Eigen::Vector2d(1, 1)), InvalidInput);
  EXPECT_THROW(fit_l1(A, d.head(2), options_), InvalidInput);
  EXPECT_THROW(fit_l1(Eigen::MatrixXd(3, 0), d, options_), InvalidInput);
  options_.tie_breaking = -1;
  EXPECT_THROW(fit_l1(A, d, options_), InvalidOptions);
}

TEST(L1Fit, BothSolversReachTheSameOptimum) {
  for (const double noise_m : {0.0, 1e-4, 0.01}) {
    Rng rng = make_stream(11, "both solvers");
    const Rows rows = room(rng, 1'000, example_twist(), noise_m, noise_m == 0);
    L1FitOptions options;
    const L1FitResult glpk = fit_l1(rows.A, rows.d, options);
    options.lp.solver = LpSolver::kCgal;
    const L1FitResult cgal = fit_l1(rows.A, rows.d, options);
    ASSERT_TRUE(glpk.optimal());
    ASSERT_TRUE(cgal.optimal());
    EXPECT_NEAR(glpk.objective, cgal.objective, 1e-7 * cgal.objective);
    EXPECT_LT((glpk.x - cgal.x).norm(), 1e-7 * cgal.x.norm());
    EXPECT_LT(std::max(glpk.duality_gap, cgal.duality_gap), 1e-10);
    EXPECT_LT(std::max(glpk.primal_infeasibility, cgal.primal_infeasibility), 1e-10);
  }
}

TEST(L1Fit, CgalIsStoppedWhereItsPricingCycles) {
  Rng rng = make_stream(9, "grid");
  const Rows rows = room(rng, 1'000, example_twist(), 0, true);
  L1FitOptions options;
  options.lp.solver = LpSolver::kCgal;
  const int pivots = fit_l1(rows.A, rows.d, options).pivots;
  ASSERT_GT(pivots, 0);

  options.tie_breaking = 0;
  options.lp.max_pivots = 30 * pivots;
  options.lp.max_seconds = 3600;  // a busy machine with sanitizers does not get there in the default's minute
  const L1FitResult stopped = fit_l1(rows.A, rows.d, options);
  EXPECT_EQ(stopped.status, LpStatus::kIterationLimit);
  EXPECT_EQ(stopped.pivots, options.lp.max_pivots);

  options.lp.max_pivots = std::numeric_limits<int>::max();
  options.lp.max_seconds = 0.2;
  const L1FitResult timed_out = fit_l1(rows.A, rows.d, options);
  EXPECT_EQ(timed_out.status, LpStatus::kTimeLimit);
  EXPECT_LT(timed_out.seconds, 10);  // wide, for a busy machine; without the limit it never ends

  options.lp.solver = LpSolver::kGlpk;
  options.lp.max_seconds = 60;
  EXPECT_TRUE(fit_l1(rows.A, rows.d, options).optimal());
}

// A hundred pivots where a textbook simplex needs one or more a row: see docs/decisions/0001.
TEST(L1Fit, TakesAtMostAHundredPivotsFor20000Rows) {
  for (const double noise_m : {0.0, 1e-4, 0.01}) {
    Rng rng = make_stream(12, "pivots");
    const Rows rows = room(rng, 20'000, example_twist(), noise_m, noise_m == 0);
    const L1FitResult result = fit_l1(rows.A, rows.d);
    ASSERT_TRUE(result.optimal());
    EXPECT_LE(result.pivots, 100);
    EXPECT_LT((result.x - example_twist()).norm(), 1e-5 + noise_m);
  }
}

TEST(L1Fit, DrawsItsNoiseFromTheSeed) {
  Rng rng = make_stream(13, "seed");
  const Rows rows = room(rng, 200, example_twist(), 0.01);
  L1FitOptions options;
  const Eigen::VectorXd x = fit_l1(rows.A, rows.d, options).x;
  EXPECT_EQ(fit_l1(rows.A, rows.d, options).x, x);
  options.seed += 1;
  EXPECT_NE(fit_l1(rows.A, rows.d, options).x, x);
}

// The least total slack of lines a + b t that lie on or above all points: one of them goes through two points.
double least_slack_above(const Eigen::VectorXd& t, const Eigen::VectorXd& d) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double slope = (d[i] - d[j]) / (t[i] - t[j]);
      const Eigen::VectorXd over = (slope * (t.array() - t[i]) + d[i] - d.array()).matrix();
      if (over.minCoeff() > -1e-12) least = std::min(least, over.sum());
    }
  }
  return least;
}

TEST(L1Fit, OneSidedIsTheClosestLineWithNothingBeyondIt) {
  Rng rng = make_stream(21, "l1_fit_test");
  Eigen::MatrixXd A(30, 2);
  Eigen::VectorXd d(30);
  for (Eigen::Index i = 0; i < 30; ++i) {
    A.row(i) << 1, 10 * uniform01(rng);
    d[i] = 3 - 0.5 * A(i, 1) + standard_normal(rng);
  }
  L1FitOptions above, below;
  above.side = L1Side::kAbove;
  below.side = L1Side::kBelow;
  const L1FitResult over = fit_l1(A, d, above), under = fit_l1(A, d, below);
  ASSERT_TRUE(over.optimal());
  ASSERT_TRUE(under.optimal());
  constexpr double kTieNoise = 2e-5;  // of right-hand sides of some metres, each moved by up to 1e-6 of their median
  EXPECT_GE((A * over.x - d).minCoeff(), -kTieNoise);
  EXPECT_LE((A * under.x - d).maxCoeff(), kTieNoise);
  EXPECT_NEAR(over.objective, least_slack_above(A.col(1), d), 30 * kTieNoise);
  EXPECT_NEAR(under.objective, least_slack_above(A.col(1), -d), 30 * kTieNoise);
  // Slack both ways leaves less of it: a choice among the three is no choice.
  EXPECT_LT(fit_l1(A, d).objective, std::min(over.objective, under.objective) - 1);
}

}  // namespace
}  // namespace tcm_icp
