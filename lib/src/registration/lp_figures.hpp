#pragma once
// What one linear program says to the registration it serves.

#include "tcm_icp/registration/l1_fit.hpp"
#include "tcm_icp/registration/registration_result.hpp"

namespace tcm_icp {

inline LpFigures figures_of(const L1FitResult& fit) {
  return {1, fit.pivots, fit.objective, fit.duality_gap, fit.seconds};
}

inline Termination termination_of(LpStatus status) {
  if (status == LpStatus::kOptimal) return Termination::kConverged;
  return status == LpStatus::kInfeasible ? Termination::kLpInfeasible : Termination::kLpFailed;
}

}  // namespace tcm_icp
