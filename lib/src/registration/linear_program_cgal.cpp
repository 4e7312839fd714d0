// CGAL behind solve(): primal simplex in exact arithmetic, stopped from inside its pricing step.

// The assertions check each pivot at several times its cost; the certificate of solve() checks the outcome instead.
#define CGAL_QP_NO_ASSERTIONS

#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <boost/iterator/iterator_adaptor.hpp>
#include <chrono>
#include <cmath>
#include <vector>

#include "registration/linear_program_solvers.hpp"

namespace tcm_icp {
namespace {

using Exact = CGAL::Gmpzf;

// What a run may spend. CGAL's solver has no limit of its own, and on tied data its default pricing can cycle for ever.
class PivotBudget {
 public:
  explicit PivotBudget(const LpOptions& options)
      : max_pivots_(options.max_pivots), max_seconds_(options.max_seconds), start_(Clock::now()) {}

  // Asked before each pivot.
  bool exhausted() {
    asked_ = true;
    if (pivots_ >= max_pivots_) {
      limit_ = LpStatus::kIterationLimit;
    } else if (std::chrono::duration<double>(Clock::now() - start_).count() > max_seconds_) {
      limit_ = LpStatus::kTimeLimit;
    }
    return limit_ != LpStatus::kNotRun;
  }
  void count_pivot() { ++pivots_; }

  bool asked() const { return asked_; }
  int pivots() const { return pivots_; }
  LpStatus limit() const { return limit_; }  // kNotRun where none was reached

 private:
  using Clock = std::chrono::steady_clock;
  int max_pivots_;
  double max_seconds_;
  Clock::time_point start_;
  int pivots_ = 0;
  bool asked_ = false;
  LpStatus limit_ = LpStatus::kNotRun;
};

// The objective's coefficients; also the way for the budget to reach the pricing, which CGAL creates itself.
class ObjectiveIterator : public boost::iterator_adaptor<ObjectiveIterator, const double*> {
 public:
  ObjectiveIterator() = default;
  ObjectiveIterator(const double* position, PivotBudget* budget) : iterator_adaptor_(position), budget_(budget) {}
  PivotBudget& budget() const { return *budget_; }

 private:
  PivotBudget* budget_ = nullptr;
};

using Program = CGAL::Linear_program_from_iterators<std::vector<const double*>::const_iterator, const double*,
                                                    CGAL::Const_oneset_iterator<CGAL::Comparison_result>, const bool*,
                                                    const double*, const bool*, const double*, ObjectiveIterator>;

// CGAL's default pricing, asked once a pivot. "No variable improves" is how a pricing ends a run: beyond the budget it
// is said untruly, the solver winds up in good order, and the budget remembers that this was no optimum.
template <typename Tags>
class BoundedPricing : public CGAL::QP_partial_filtered_pricing<Program, Exact, Tags> {
  using Base = CGAL::QP_partial_filtered_pricing<Program, Exact, Tags>;

 public:
  BoundedPricing() : CGAL::QP_pricing_strategy<Program, Exact, Tags>("bounded partial filtered") {}

  int pricing(int& direction) override {
    PivotBudget& budget = this->solver().c_begin().budget();
    if (budget.exhausted()) return -1;
    const int entering = Base::pricing(direction);
    if (entering >= 0) budget.count_pivot();
    return entering;
  }
};

}  // namespace
}  // namespace tcm_icp

// CGAL has no public way to pass a pricing of one's own; this is where it looks up the one for `Program`.
template <typename Tags>
struct CGAL::QP_solver_impl::Filtered_pricing_strategy_selector<tcm_icp::Program, tcm_icp::Exact, Tags, double> {
  using PF = tcm_icp::BoundedPricing<Tags>;
  using FF = tcm_icp::BoundedPricing<Tags>;
};

namespace tcm_icp {
namespace {

// The program as CGAL reads it: dense columns, minimised, a flag and a finite number for each bound.
struct Storage {
  explicit Storage(const LinearProgram& lp)
      : equations(lp.equations),
        rhs(lp.rhs),
        negated_objective(-lp.objective),
        has_lower(lp.lower.array().isFinite()),
        has_upper(lp.upper.array().isFinite()),
        lower(has_lower.select(lp.lower, 0.0)),
        upper(has_upper.select(lp.upper, 0.0)) {
    for (Eigen::Index j = 0; j < equations.cols(); ++j) columns.push_back(equations.col(j).data());
  }

  Program program(PivotBudget& budget) const {
    const CGAL::Const_oneset_iterator<CGAL::Comparison_result> equal(CGAL::EQUAL);
    return Program(static_cast<int>(equations.cols()), static_cast<int>(equations.rows()), columns.begin(), rhs.data(),
                   equal, has_lower.data(), lower.data(), has_upper.data(), upper.data(),
                   ObjectiveIterator(negated_objective.data(), &budget));
  }

  Eigen::MatrixXd equations;
  Eigen::VectorXd rhs;
  Eigen::VectorXd negated_objective;
  Eigen::Array<bool, Eigen::Dynamic, 1> has_lower;
  Eigen::Array<bool, Eigen::Dynamic, 1> has_upper;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  std::vector<const double*> columns;
};

using ExactSolution = CGAL::Quadratic_program_solution<Exact>;

LpStatus status_of(const ExactSolution& exact, const PivotBudget& budget) {
  // A pricing that was never asked cannot have been ours: nothing would bound the run.
  if (!budget.asked()) return LpStatus::kFailed;
  if (budget.limit() != LpStatus::kNotRun) return budget.limit();
  if (exact.is_optimal()) return LpStatus::kOptimal;
  return exact.is_infeasible() ? LpStatus::kInfeasible : LpStatus::kUnbounded;
}

}  // namespace

void solve_with_cgal(const LinearProgram& lp, const LpOptions& options, LpSolution& solution) {
  if (lp.equations.cols() > options.cgal_max_columns) {
    solution.status = LpStatus::kSizeLimit;
    return;
  }
  const Storage storage(lp);
  PivotBudget budget(options);
  const ExactSolution exact = CGAL::solve_linear_program(storage.program(budget), Exact());
  solution.status = status_of(exact, budget);
  solution.pivots = budget.pivots();
  if (solution.status != LpStatus::kOptimal) return;

  solution.y.resize(lp.equations.cols());
  auto value = exact.variable_values_begin();
  for (double& y : solution.y) y = CGAL::to_double(*value++);
  // With f = -objective, CGAL's multipliers obey f + equations' lambda >= 0 at lower bounds: lambda is pi.
  solution.row_duals.resize(lp.equations.rows());
  auto multiplier = exact.optimality_certificate_begin();
  for (double& dual : solution.row_duals) dual = CGAL::to_double(*multiplier++);
}

}  // namespace tcm_icp
