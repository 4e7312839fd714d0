#pragma once
// Blunders that show in the scans themselves, before any is placed.

#include <string>
#include <utility>
#include <vector>

#include "scans/scan_sampling.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// One sentence for each scan whose coordinates seem to be in another unit than those of the other scans, with the
/// likely units and the option that mends it. A unit multiplies extent, spacing and noise alike: a scan is named where
/// the three together are farther from those of the other scans than one ordinary scan in a thousand is, would not be
/// so in the other unit, and each of them is nearer to what it would be there. Of two scans the larger one is named.
std::vector<std::string> unit_doubts(const std::vector<ScanSummary>& scans);

/// Warns of them; what was said.
std::vector<std::string> warn_of_units(const std::vector<ScanSummary>& scans, const RunContext& context);

/// Names of scans, each with an earlier one that has the very same points under another name.
std::vector<std::pair<std::string, std::string>> find_twins(const std::vector<SampledScan>& scans);

/// @throws InvalidInput  naming both, where two scans are the same: a copy would bear its original out
void refuse_twins(const std::vector<SampledScan>& scans);

}  // namespace tcm_icp
