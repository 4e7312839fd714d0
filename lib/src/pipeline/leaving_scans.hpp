#pragma once
// Which members leave a component when decisions were made.

#include <cstddef>
#include <vector>

#include "inference/cuts.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/decision/scan_decision.hpp"

namespace tcm_icp {

/// Nobody, where all pass. Where pairs speak against a cut as poses are adjusted, its smaller side alone. Else the
/// worst of those that do not pass, with what would move with it where its place is ambiguous; and of the others those
/// that are linked to none of them: what a scan that does not pass is linked to is judged again without it, whether it
/// leaves now or waits for a worse one itself.
/// @param members    of the component, ascending
/// @param decisions  of every scan of the set; those of members are asked
/// @param cuts       of the component
/// @param pairs      of members that overlap
/// Cost: scans that do not pass, times cuts and pairs.
std::vector<std::size_t> leaving_scans(const std::vector<std::size_t>& members, const std::vector<Decision>& decisions,
                                       const std::vector<Cut>& cuts, const ScanPairs& pairs);

}  // namespace tcm_icp
