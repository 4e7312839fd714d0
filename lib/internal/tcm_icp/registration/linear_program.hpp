#pragma once
// Linear programs with few equations and many bounded variables, and the two simplex solvers for them.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <limits>
#include <string_view>

namespace tcm_icp {

/// Maximise objective' y subject to equations * y = rhs, lower <= y <= upper. Bounds may be infinite; equal ones fix
/// y_j.
struct LinearProgram {
  Eigen::SparseMatrix<double> equations;  ///< M x N; stored by column, since M is small (6 a scan) and N large
  Eigen::VectorXd rhs;                    ///< M
  Eigen::VectorXd objective;              ///< N
  Eigen::VectorXd lower;                  ///< N; -infinity where there is none
  Eigen::VectorXd upper;                  ///< N; +infinity where there is none

  /// @throws InvalidInput  if sizes disagree, M = 0, a coefficient is not finite, a bound is NaN, or lower > upper
  void validate() const;
};

enum class LpSolver {
  kGlpk,  ///< dual simplex in double precision with the long-step ratio test
  kCgal,  ///< primal simplex in exact arithmetic; for small problems and as a cross-check
};

enum class LpStatus {
  kNotRun,
  kOptimal,         ///< and the certificate holds: see LpOptions::max_certificate_error
  kInfeasible,      ///< no y satisfies equations and bounds
  kUnbounded,       ///< the objective has no maximum
  kIterationLimit,  ///< max_pivots did not suffice
  kTimeLimit,       ///< max_seconds did not suffice
  kSizeLimit,       ///< too large for the solver asked for: not started
  kFailed,          ///< the solver gave up, or its answer failed the certificate
};

std::string_view to_string(LpSolver solver);
std::string_view to_string(LpStatus status);

struct LpOptions {
  LpSolver solver = LpSolver::kGlpk;
  int max_pivots = 100'000;             ///< >= 1
  double max_seconds = 60;              ///< [s] > 0; a safeguard: where it strikes, the outcome depends on the machine
  int cgal_max_columns = 5'000;         ///< >= 1; larger programs are kSizeLimit: CGAL's time grows with N squared
  double max_certificate_error = 1e-7;  ///< > 0; larger duality gap or infeasibility turns kOptimal into kFailed

  void validate() const;  ///< throws InvalidOptions naming field, value and bound
};

/// How good y is, whichever solver it comes from. Weak duality: for every pi, with z = objective - equations' pi,
///   objective' y  <=  rhs' pi + sum_j max(lower_j z_j, upper_j z_j),   with equality at an optimum only.
/// The gap is relative to the terms of these sums, sum_j |objective_j| max(|y_j|, |bound_j|), not to their value, which
/// may be 0 (an exact fit).
struct LpCertificate {
  double objective = std::numeric_limits<double>::quiet_NaN();             ///< objective' y
  double dual_objective = std::numeric_limits<double>::quiet_NaN();        ///< the right-hand side above
  double duality_gap = std::numeric_limits<double>::quiet_NaN();           ///< relative difference of the two
  double primal_infeasibility = std::numeric_limits<double>::quiet_NaN();  ///< relative: worst equation or bound
};

/// @param y, row_duals  N and M numbers, finite
/// @throws InvalidInput  if `lp` is not valid or a size is wrong
/// Cost O(non-zeros of the equations).
LpCertificate certify(const LinearProgram& lp, const Eigen::VectorXd& y, const Eigen::VectorXd& row_duals);

struct LpSolution : LpCertificate {
  LpStatus status = LpStatus::kNotRun;
  Eigen::VectorXd y;          ///< N; empty unless the solver reported an optimum
  Eigen::VectorXd row_duals;  ///< M; pi, the change of the maximum per unit of rhs; empty like y
  int pivots = 0;             ///< simplex iterations
  double seconds = 0;         ///< [s] wall time

  bool optimal() const { return status == LpStatus::kOptimal; }
};

/// Solves `lp` with the solver asked for; a numerical outcome is a status, and no other solver is tried. An optimum is
/// called so only if its certificate, computed here and not by the solver, is within max_certificate_error.
///
/// @throws InvalidOptions, InvalidInput  see the validate() functions
/// Cost: GLPK about 40 pivots of O(N) for 6 equations, CGAL about N such pivots (docs/decisions/0001). Thread-safe;
/// same bits on every thread.
LpSolution solve(const LinearProgram& lp, const LpOptions& options = {});

}  // namespace tcm_icp
