#pragma once
// Lines 4 to 9 of Algorithm 1 over inferred poses: S grows scan by scan in the order of the TCM.

#include <vector>

#include "inference/compared_pairs.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/merging/merge_options.hpp"
#include "tcm_icp/merging/merge_record.hpp"

namespace tcm_icp {

/// Merges the members of a component, those first that hypotheses join to what is merged. With options.fits each is
/// fitted to S by linear programs, from where inference puts it beside the merged scan it overlaps with most, and
/// refined as the options ask for; a fit that leaves that pose is not taken, since inference has looked at more than S.
/// Poses of `component` follow the fits. Without, they stay.
/// @return  a record for each member but the reference, in the order of merging
std::vector<MergeRecord> merge_in_tcm_order(const std::vector<PreparedScan>& scans, const PairGraph& graph,
                                            const MergeOptions& options, const RunContext& context,
                                            Component& component);

}  // namespace tcm_icp
