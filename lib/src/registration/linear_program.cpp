#include "tcm_icp/registration/linear_program.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "registration/linear_program_solvers.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool all_finite(const Eigen::SparseMatrix<double>& matrix) {
  for (Eigen::Index j = 0; j < matrix.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it) {
      if (!std::isfinite(it.value())) return false;
    }
  }
  return true;
}

// max(lower z, upper z), the most that one variable with reduced cost z can add, is z times this. A reduced cost of
// pure rounding error must not count as infinite where there is no bound.
double best_bound(double lower, double upper, double z, double rounding) {
  const double bound = z > 0 ? upper : lower;
  return std::isinf(bound) && std::abs(z) <= rounding ? 0.0 : bound;
}

void certify_objective(const LinearProgram& lp, const Eigen::VectorXd& y, const Eigen::VectorXd& row_duals,
                       LpCertificate& certificate) {
  constexpr double kRounding = 1e-9;  // of the terms a reduced cost is the difference of
  double dual = lp.rhs.dot(row_duals);
  double magnitude = 0;  // the unit in which a sum of this size can be wrong
  for (Eigen::Index j = 0; j < lp.objective.size(); ++j) {
    double z = lp.objective[j];
    double size = std::abs(z);
    for (Eigen::SparseMatrix<double>::InnerIterator it(lp.equations, j); it; ++it) {
      z -= it.value() * row_duals[it.row()];
      size += std::abs(it.value() * row_duals[it.row()]);
    }
    const double bound = best_bound(lp.lower[j], lp.upper[j], z, kRounding * size);
    dual += bound * z;
    magnitude += std::abs(lp.objective[j]) * std::max(std::abs(y[j]), std::isinf(bound) ? 0.0 : std::abs(bound));
  }
  certificate.objective = lp.objective.dot(y);
  certificate.dual_objective = dual;
  const double gap = std::abs(dual - certificate.objective);
  certificate.duality_gap = gap == 0 ? 0 : gap / std::max(magnitude, std::numeric_limits<double>::min());
}

// Worst violation: of an equation relative to sum |coefficient| max(1, |y|), of a bound to max(1, |bound|). The 1 is
// the usual absolute tolerance of a simplex; without it y = 1e-17 in place of 0 would be infeasible.
double primal_infeasibility(const LinearProgram& lp, const Eigen::VectorXd& y) {
  const Eigen::VectorXd residual = lp.equations * y - lp.rhs;
  const Eigen::VectorXd magnitude = lp.equations.cwiseAbs() * y.cwiseAbs().cwiseMax(1.0) + lp.rhs.cwiseAbs();
  double worst = 0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (residual[i] != 0) worst = std::max(worst, std::abs(residual[i]) / magnitude[i]);
  }
  for (Eigen::Index j = 0; j < y.size(); ++j) {
    const double below = lp.lower[j] - y[j];
    const double above = y[j] - lp.upper[j];
    if (below > 0) worst = std::max(worst, below / std::max(1.0, std::abs(lp.lower[j])));
    if (above > 0) worst = std::max(worst, above / std::max(1.0, std::abs(lp.upper[j])));
  }
  return worst;
}

// An optimum is one only if its certificate says so.
void confirm_optimum(const LinearProgram& lp, const LpOptions& options, LpSolution& solution) {
  if (!solution.y.allFinite() || !solution.row_duals.allFinite()) {
    solution.status = LpStatus::kFailed;
    return;
  }
  static_cast<LpCertificate&>(solution) = certify(lp, solution.y, solution.row_duals);
  // Written so that NaN fails.
  const bool holds = solution.duality_gap <= options.max_certificate_error &&
                     solution.primal_infeasibility <= options.max_certificate_error;
  if (!holds) solution.status = LpStatus::kFailed;
}

// Without variables there is nothing to choose: 0 = rhs holds or not.
void solve_without_columns(const LinearProgram& lp, LpSolution& solution) {
  solution.status = lp.rhs.isZero(0) ? LpStatus::kOptimal : LpStatus::kInfeasible;
  solution.y.resize(0);
  solution.row_duals = Eigen::VectorXd::Zero(lp.rhs.size());
}

}  // namespace

std::string_view to_string(LpSolver solver) { return solver == LpSolver::kGlpk ? "glpk" : "cgal"; }

std::string_view to_string(LpStatus status) {
  switch (status) {
    case LpStatus::kNotRun:
      return "not_run";
    case LpStatus::kOptimal:
      return "optimal";
    case LpStatus::kInfeasible:
      return "infeasible";
    case LpStatus::kUnbounded:
      return "unbounded";
    case LpStatus::kIterationLimit:
      return "iteration_limit";
    case LpStatus::kTimeLimit:
      return "time_limit";
    case LpStatus::kSizeLimit:
      return "size_limit";
    case LpStatus::kFailed:
      return "failed";
  }
  return "unknown";
}

void LpOptions::validate() const {
  if (max_pivots < 1) {
    throw InvalidOptions("LpOptions: max_pivots is " + std::to_string(max_pivots) + ", must be >= 1");
  }
  if (!(max_seconds > 0)) {
    throw InvalidOptions("LpOptions: max_seconds is " + std::to_string(max_seconds) + ", must be > 0");
  }
  if (cgal_max_columns < 1) {
    throw InvalidOptions("LpOptions: cgal_max_columns is " + std::to_string(cgal_max_columns) + ", must be >= 1");
  }
  if (!(max_certificate_error > 0)) {
    throw InvalidOptions("LpOptions: max_certificate_error is " + std::to_string(max_certificate_error) +
                         ", must be > 0");
  }
}

void LinearProgram::validate() const {
  const Eigen::Index n = equations.cols();
  if (equations.rows() == 0) throw InvalidInput("linear program: no equations");
  if (rhs.size() != equations.rows() || objective.size() != n || lower.size() != n || upper.size() != n) {
    throw InvalidInput("linear program: sizes of equations, rhs, objective and bounds disagree");
  }
  if (!all_finite(equations) || !rhs.allFinite() || !objective.allFinite()) {
    throw InvalidInput("linear program: a coefficient is not finite");
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    // Written so that NaN fails.
    if (!(lower[j] <= upper[j]) || lower[j] == kInfinity || upper[j] == -kInfinity) {
      throw InvalidInput("linear program: bounds of variable " + std::to_string(j) + " leave it no value");
    }
  }
}

LpCertificate certify(const LinearProgram& lp, const Eigen::VectorXd& y, const Eigen::VectorXd& row_duals) {
  lp.validate();
  if (y.size() != lp.objective.size() || row_duals.size() != lp.rhs.size()) {
    throw InvalidInput("certificate of a linear program: sizes of y or row_duals disagree with it");
  }
  LpCertificate certificate;
  certify_objective(lp, y, row_duals, certificate);
  certificate.primal_infeasibility = primal_infeasibility(lp, y);
  return certificate;
}

LpSolution solve(const LinearProgram& lp, const LpOptions& options) {
  options.validate();
  lp.validate();
  const auto start = std::chrono::steady_clock::now();
  LpSolution solution;
  if (lp.objective.size() == 0) {
    solve_without_columns(lp, solution);
  } else if (options.solver == LpSolver::kGlpk) {
    solve_with_glpk(lp, options, solution);
  } else {
    solve_with_cgal(lp, options, solution);
  }
  if (solution.status == LpStatus::kOptimal) confirm_optimum(lp, options, solution);
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

}  // namespace tcm_icp
