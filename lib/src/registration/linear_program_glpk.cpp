// GLPK behind solve(): dual simplex, long-step ratio test.

#include <glpk.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "registration/linear_program_solvers.hpp"

namespace tcm_icp {
namespace {

// GLPK calls abort() beyond its own limits (100 million rows or columns, 500 million coefficients).
constexpr Eigen::Index kMaxColumns = 50'000'000;
constexpr Eigen::Index kMaxNonZeros = 400'000'000;

using Problem = std::unique_ptr<glp_prob, decltype(&glp_delete_prob)>;

// GLPK keeps one environment per thread and frees it only when told to: here, when the thread ends.
struct ThreadEnvironment {
  ~ThreadEnvironment() { glp_free_env(); }
};

// Silences the terminal, and gives a caller who uses GLPK himself his setting back.
class SilentTerminal {
 public:
  SilentTerminal() : previous_(glp_term_out(GLP_OFF)) {}
  ~SilentTerminal() { glp_term_out(previous_); }
  SilentTerminal(const SilentTerminal&) = delete;
  SilentTerminal& operator=(const SilentTerminal&) = delete;

 private:
  int previous_;
};

int bound_kind(double lower, double upper) {
  if (lower == upper) return GLP_FX;
  if (std::isinf(lower)) return std::isinf(upper) ? GLP_FR : GLP_UP;
  return std::isinf(upper) ? GLP_LO : GLP_DB;
}

// GLPK numbers rows, columns and coefficients from 1.
void add_column(glp_prob* problem, const LinearProgram& lp, int j, std::vector<int>& rows,
                std::vector<double>& values) {
  rows.assign(1, 0);
  values.assign(1, 0.0);
  for (Eigen::SparseMatrix<double>::InnerIterator it(lp.equations, j); it; ++it) {
    if (it.value() == 0) continue;
    rows.push_back(static_cast<int>(it.row()) + 1);
    values.push_back(it.value());
  }
  glp_set_mat_col(problem, j + 1, static_cast<int>(rows.size()) - 1, rows.data(), values.data());
  glp_set_obj_coef(problem, j + 1, lp.objective[j]);
  glp_set_col_bnds(problem, j + 1, bound_kind(lp.lower[j], lp.upper[j]), lp.lower[j], lp.upper[j]);
}

Problem create_problem(const LinearProgram& lp) {
  Problem problem(glp_create_prob(), &glp_delete_prob);
  glp_set_obj_dir(problem.get(), GLP_MAX);
  const int num_rows = static_cast<int>(lp.equations.rows());
  const int num_columns = static_cast<int>(lp.equations.cols());
  glp_add_rows(problem.get(), num_rows);
  glp_add_cols(problem.get(), num_columns);
  for (int i = 0; i < num_rows; ++i) {
    glp_set_row_bnds(problem.get(), i + 1, GLP_FX, lp.rhs[i], lp.rhs[i]);
  }
  std::vector<int> rows;
  std::vector<double> values;
  for (int j = 0; j < num_columns; ++j) add_column(problem.get(), lp, j, rows, values);
  return problem;
}

glp_smcp simplex_parameters(const LpOptions& options) {
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.meth = GLP_DUAL;
  // Thousands of boxed variables change bounds in one step; with the usual ratio test each is a pivot of its own.
  parameters.r_test = GLP_RT_FLIP;
  // Well below the certificate's bound; GLPK's own 1e-7 is not.
  parameters.tol_bnd = 1e-9;
  parameters.tol_dj = 1e-9;
  parameters.it_lim = options.max_pivots;
  const double milliseconds = std::ceil(options.max_seconds * 1e3);
  parameters.tm_lim =
      milliseconds < std::numeric_limits<int>::max() ? static_cast<int>(milliseconds) : std::numeric_limits<int>::max();
  return parameters;
}

// 0 from glp_simplex means "ran"; what came of it is the problem's status.
LpStatus status_of(int code, glp_prob* problem) {
  if (code == GLP_EITLIM) return LpStatus::kIterationLimit;
  if (code == GLP_ETMLIM) return LpStatus::kTimeLimit;
  if (code != 0) return LpStatus::kFailed;
  switch (glp_get_status(problem)) {
    case GLP_OPT:
      return LpStatus::kOptimal;
    case GLP_NOFEAS:
      return LpStatus::kInfeasible;
    case GLP_UNBND:
      return LpStatus::kUnbounded;
    default:
      return LpStatus::kFailed;
  }
}

}  // namespace

void solve_with_glpk(const LinearProgram& lp, const LpOptions& options, LpSolution& solution) {
  if (lp.equations.cols() > kMaxColumns || lp.equations.rows() > kMaxColumns ||
      lp.equations.nonZeros() > kMaxNonZeros) {
    solution.status = LpStatus::kSizeLimit;
    return;
  }
  static thread_local ThreadEnvironment environment;
  const SilentTerminal silence;
  const Problem problem = create_problem(lp);
  glp_smcp parameters = simplex_parameters(options);
  int code = glp_simplex(problem.get(), &parameters);
  // A dual without feasible point leaves open whether the primal is unbounded or infeasible: the primal simplex tells.
  if (code == 0 && glp_get_dual_stat(problem.get()) == GLP_NOFEAS && glp_get_status(problem.get()) != GLP_UNBND) {
    parameters.meth = GLP_PRIMAL;
    code = glp_simplex(problem.get(), &parameters);
  }
  solution.pivots = glp_get_it_cnt(problem.get());
  solution.status = status_of(code, problem.get());
  if (solution.status != LpStatus::kOptimal) return;

  solution.y.resize(lp.equations.cols());
  for (int j = 0; j < solution.y.size(); ++j) solution.y[j] = glp_get_col_prim(problem.get(), j + 1);
  solution.row_duals.resize(lp.equations.rows());
  for (int i = 0; i < solution.row_duals.size(); ++i) solution.row_duals[i] = glp_get_row_dual(problem.get(), i + 1);
}

}  // namespace tcm_icp
