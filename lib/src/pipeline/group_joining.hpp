#pragma once
// Groups of scans that hold together, tried against one another as if each were one scan.

#include <cstddef>
#include <optional>
#include <vector>

#include "adjusted_set.hpp"
#include "merging.hpp"
#include "prepared_scan.hpp"

namespace tcm_icp {

/// Sets that became one, not yet adjusted or judged as such.
struct GroupJoin {
  std::vector<std::size_t> parts;  ///< of the sets given; the first keeps its reference
  AdjustedSet set;
};

/// What no link between two scans could show, the clouds of two groups may: they see more of one another. Every group
/// of two scans or more is merged into one cloud, and goes through the same steps as scans do, with the other groups
/// and the scans no group took: coarse alignment, links, merging in the order of the TCM. The first set stays the
/// reference of what joins it; a scan or group that joins no set is left as it is.
/// @param sets    groups, disjoint, the most important first
/// @param merges  records are added, one for each group or scan that was tried
/// @return        the first join found; nothing where no two belong together
std::optional<GroupJoin> join_groups(const MergeInput& input, const Resolutions& resolutions,
                                     const std::vector<AdjustedSet>& sets, std::vector<MergeRecord>& merges);

}  // namespace tcm_icp
