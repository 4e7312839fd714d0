#pragma once
// The two solvers behind solve(): each fills status, y, row_duals and pivots; `lp` is validated and has columns.

#include "tcm_icp/registration/linear_program.hpp"

namespace tcm_icp {

void solve_with_glpk(const LinearProgram& lp, const LpOptions& options, LpSolution& solution);
void solve_with_cgal(const LinearProgram& lp, const LpOptions& options, LpSolution& solution);

}  // namespace tcm_icp
