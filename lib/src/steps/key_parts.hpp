#pragma once
// Options of fits as parts of keys and records, each field by name, so that a field more does not compile before it is
// listed here.

#include "steps/step_record.hpp"
#include "tcm_icp/registration/l1_fit.hpp"

namespace tcm_icp {

template <typename Record, MaybeConst<LpOptions> T>
void transfer(Record& record, T& value) {
  auto& [solver, max_pivots, max_seconds, max_columns, max_certificate_error] = value;
  record(solver, max_pivots, max_seconds, max_columns, max_certificate_error);
}

template <typename Record, MaybeConst<L1FitOptions> T>
void transfer(Record& record, T& value) {
  auto& [lp, side, tie_breaking, seed, rank_tolerance] = value;
  record(lp, side, tie_breaking, seed, rank_tolerance);
}

}  // namespace tcm_icp
