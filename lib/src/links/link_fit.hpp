#pragma once
// Coarse candidates of a pair, put in order, fitted and measured.

#include <optional>
#include <vector>

#include "links/hypotheses.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/registration/lp_registration.hpp"

namespace tcm_icp {

struct LinkSearchOptions {
  LpFormulation formulation = LpFormulation::kPointToPlane;
  L1FitOptions lp;
  bool level = false;  ///< z points up in every scan: links that tilt one against another are not tried
  bool features = true, slides = true;  ///< false: pairs' poses are not searched for by them
};

/// Each method's best first, then those whose points lie nearest the target.
std::vector<PoseCandidate> in_order_of_promise(const PreparedScan& target, const PreparedScan& source,
                                               const std::vector<PoseCandidate>& candidates);

/// A candidate fitted by linear programs over a light sample, and what is measured there; T_a_b is T_target_source.
/// Where that ends farther off than the candidate may be (accuracy_m), the better of it and a second, by matches from
/// near alone. Nothing where far too much is seen through walls before the fit, or the fit fails. Log-odds are not set
/// yet.
std::optional<LinkHypothesis> fit_candidate(const PreparedScan& target, const PreparedScan& source,
                                            const PoseCandidate& candidate, const LinkSearchOptions& options);

}  // namespace tcm_icp
