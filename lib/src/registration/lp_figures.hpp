#pragma once
// Adds up what the linear programs of a registration did.

#include <cmath>

#include "tcm_icp/registration/l1_fit.hpp"
#include "tcm_icp/registration/registration_result.hpp"

namespace tcm_icp {

inline void add_to(LpFigures& figures, const L1FitResult& fit) {
  figures.num_programs += 1;
  figures.num_pivots += fit.pivots;
  figures.seconds += fit.seconds;
  figures.objective = fit.objective;
  figures.relative_duality_gap = std::fmax(figures.relative_duality_gap, fit.duality_gap);
}

inline Termination termination_of(LpStatus status) {
  if (status == LpStatus::kOptimal) return Termination::kConverged;
  return status == LpStatus::kInfeasible ? Termination::kLpInfeasible : Termination::kLpFailed;
}

}  // namespace tcm_icp
