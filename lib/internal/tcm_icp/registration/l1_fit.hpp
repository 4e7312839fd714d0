#pragma once
// Least absolute deviations: the line fit behind the simplex step.

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "tcm_icp/registration/linear_program.hpp"

namespace tcm_icp {

/// Where A x may lie: on both sides of d, or nowhere below or above it.
enum class L1Side { kBoth, kAbove, kBelow };

struct L1FitOptions {
  LpOptions lp;
  L1Side side = L1Side::kBoth;
  double tie_breaking = 1e-6;    ///< >= 0; noise on d, in units of the median non-zero |d|, so that no two vertices tie
  std::uint64_t seed = 42;       ///< of that noise
  double rank_tolerance = 1e-6;  ///< in (0, 1); directions of x weaker than this share of the strongest stay 0

  void validate() const;  ///< throws InvalidOptions
};

struct L1FitResult {
  LpStatus status = LpStatus::kNotRun;
  Eigen::VectorXd x;  ///< n; NaN unless the status is kOptimal
  int rank = 0;       ///< directions of x the rows determine; below n the others are 0
  double objective = std::numeric_limits<double>::quiet_NaN();             ///< sum_i w_i |A x - d|_i of the data given
  double duality_gap = std::numeric_limits<double>::quiet_NaN();           ///< see LpSolution
  double primal_infeasibility = std::numeric_limits<double>::quiet_NaN();  ///< see LpSolution
  int pivots = 0;
  double seconds = 0;  ///< [s] wall time

  bool optimal() const { return status == LpStatus::kOptimal; }
};

/// min over x of sum_i w_i |(A x - d)_i|, through its dual: max d'y, A'y = 0, -w <= y <= w; x is the dual of A'y = 0.
///
/// One-sided (A x >= d, or <=, for every row of weight above 0) y has no bound on the side that must stay empty: the
/// same program with the weight there infinite.
///
/// Columns of A are divided by their root mean square and d by the median of its non-zero absolute values, so units do
/// not matter. Seeded noise of tie_breaking on d is part of the program, the same for both solvers: without it regular
/// data (a grid, a flat wall) ties and CGAL's pricing cycles. It moves the optimum by at most
/// 2 tie_breaking median|d| sum_i w_i.
///
/// Rank-deficient A (parallel normals, fewer rows than columns, a zero column) has a whole flat of minimisers. Returned
/// is the one without any component, in scaled columns, along the directions that the rows do not determine.
///
/// @param A        N x n, n >= 1
/// @param d        N
/// @param weights  N, >= 0, or empty for 1; rows of weight 0 do not count
/// @throws InvalidInput  if sizes disagree, n = 0, a number is not finite or a weight negative
/// @note Without rows, and for d = 0, x = 0 is optimal and no program is solved.
/// Cost O(N n^2) and the program's; N = 20,000, n = 6: see docs/decisions/0001. Thread-safe.
L1FitResult fit_l1(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::VectorXd>& d,
                   const L1FitOptions& options = {},
                   const Eigen::Ref<const Eigen::VectorXd>& weights = Eigen::VectorXd());

}  // namespace tcm_icp
