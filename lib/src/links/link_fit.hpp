#pragma once
// Coarse candidates of a pair, put in order, fitted and measured.

#include <optional>
#include <vector>

#include "links/hypotheses.hpp"
#include "pipeline/prepared_scan.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"

namespace tcm_icp {

/// Each method's best first, then those whose points lie nearest the target.
std::vector<PoseCandidate> in_order_of_promise(const PreparedScan& target, const PreparedScan& source,
                                               const std::vector<PoseCandidate>& candidates);

/// A candidate fitted by linear programs over a light sample, and what is measured there; T_a_b is T_target_source.
/// Nothing where far too much is seen through walls before the fit, or the fit fails. Log-odds are not set yet.
std::optional<LinkHypothesis> fit_candidate(const PreparedScan& target, const PreparedScan& source,
                                            const PoseCandidate& candidate, const PipelineOptions& options);

}  // namespace tcm_icp
