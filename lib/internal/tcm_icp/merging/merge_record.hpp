#pragma once
// What merging found out about one scan.

#include <cstddef>
#include <optional>
#include <string>

#include "tcm_icp/registration/refinement.hpp"
#include "tcm_icp/registration/registration_result.hpp"
#include "tcm_icp/tcm/tcm.hpp"

namespace tcm_icp {

/// How a scan was merged into S.
struct MergeRecord {
  std::size_t scan = 0;
  TcmTerms tcm;  ///< against S, before the simplex
  RegistrationResult simplex;
  std::optional<RefinementTrace> descent;
  std::optional<RefinementTrace> annealing;
  bool accepted = false;  ///< the fit was taken: in the robust profile it stays where links lead
  std::string reason;
};

}  // namespace tcm_icp
