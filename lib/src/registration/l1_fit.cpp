#include "tcm_icp/registration/l1_fit.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "determined_directions.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

struct Rows {
  Eigen::MatrixXd A;
  Eigen::VectorXd d;
  Eigen::VectorXd weights;
};

void check_input(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::VectorXd>& d,
                 const Eigen::Ref<const Eigen::VectorXd>& weights) {
  if (A.cols() == 0) throw InvalidInput("L1 fit: no unknowns");
  if (d.size() != A.rows() || (weights.size() != 0 && weights.size() != A.rows())) {
    throw InvalidInput("L1 fit: numbers of rows, right-hand sides and weights disagree");
  }
  if (!A.allFinite() || !d.allFinite() || !weights.allFinite()) throw InvalidInput("L1 fit: a number is not finite");
  if (weights.size() != 0 && weights.minCoeff() < 0) throw InvalidInput("L1 fit: a weight is negative");
}

// Rows that count, weights with mean 1.
Rows weighted_rows(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::VectorXd>& d,
                   const Eigen::Ref<const Eigen::VectorXd>& weights) {
  if (weights.size() == 0) return {A, d, Eigen::VectorXd::Ones(d.size())};
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0) kept.push_back(i);
  }
  Rows rows{A(kept, Eigen::all), d(kept), weights(kept)};
  if (!kept.empty()) rows.weights /= rows.weights.mean();
  return rows;
}

// Root mean square of each column; 1 for a zero column, which its null direction takes care of.
Eigen::VectorXd column_scales(const Eigen::MatrixXd& A) {
  Eigen::VectorXd scales = A.colwise().stableNorm().transpose() / std::sqrt(static_cast<double>(A.rows()));
  return scales.unaryExpr([](double scale) { return scale > 0 ? scale : 1.0; });
}

LinearProgram dual_program(const Eigen::MatrixXd& A, const Eigen::VectorXd& d, const Eigen::VectorXd& weights,
                           const L1FitOptions& options) {
  LinearProgram lp;
  lp.equations = Eigen::MatrixXd(A.transpose()).sparseView(0, 0);
  lp.rhs = Eigen::VectorXd::Zero(A.cols());
  lp.objective = d;
  Rng rng = make_stream(options.seed, "l1_fit tie breaking");
  for (double& value : lp.objective) value += options.tie_breaking * (2 * uniform01(rng) - 1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  lp.lower = -weights;
  lp.upper = weights;
  if (options.side == L1Side::kBelow) lp.lower.setConstant(-kInfinity);
  if (options.side == L1Side::kAbove) lp.upper.setConstant(kInfinity);
  return lp;
}

// Fills all of `result` but objective and seconds.
void solve_scaled(const Rows& rows, const L1FitOptions& options, L1FitResult& result) {
  const Eigen::VectorXd magnitudes = rows.d.cwiseAbs();
  const double d_scale = median_nonzero({magnitudes.begin(), magnitudes.end()});
  const Eigen::VectorXd scales = column_scales(rows.A);
  const Eigen::MatrixXd scaled_A = rows.A * scales.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd basis = determined_directions(scaled_A, options.rank_tolerance);
  result.rank = static_cast<int>(basis.cols());
  if (result.rank == 0 || d_scale == 0) {
    result.status = LpStatus::kOptimal;
    result.x.setZero();
    result.duality_gap = result.primal_infeasibility = 0;
    return;
  }
  const LpSolution lp = solve(dual_program(scaled_A * basis, rows.d / d_scale, rows.weights, options), options.lp);
  result.status = lp.status;
  result.duality_gap = lp.duality_gap;
  result.primal_infeasibility = lp.primal_infeasibility;
  result.pivots = lp.pivots;
  if (lp.optimal()) result.x = d_scale * scales.cwiseInverse().cwiseProduct(basis * lp.row_duals);
}

}  // namespace

void L1FitOptions::validate() const {
  lp.validate();
  if (!(tie_breaking >= 0) || !(tie_breaking < 1)) {
    throw InvalidOptions("L1FitOptions: tie_breaking is " + std::to_string(tie_breaking) + ", must be in [0, 1)");
  }
  if (!(rank_tolerance > 0) || !(rank_tolerance < 1)) {
    throw InvalidOptions("L1FitOptions: rank_tolerance is " + std::to_string(rank_tolerance) + ", must be in (0, 1)");
  }
}

L1FitResult fit_l1(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::VectorXd>& d,
                   const L1FitOptions& options, const Eigen::Ref<const Eigen::VectorXd>& weights) {
  options.validate();
  check_input(A, d, weights);
  const auto start = std::chrono::steady_clock::now();
  L1FitResult result;
  result.x = Eigen::VectorXd::Constant(A.cols(), std::numeric_limits<double>::quiet_NaN());
  solve_scaled(weighted_rows(A, d, weights), options, result);
  const Eigen::VectorXd residuals = (A * result.x - d).cwiseAbs();
  result.objective = weights.size() == 0 ? residuals.sum() : weights.dot(residuals);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace tcm_icp
