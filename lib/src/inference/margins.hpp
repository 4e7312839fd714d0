#pragma once
// Where groups that hang together might go on.

#include <cstddef>
#include <vector>

#include "inference/compared_pairs.hpp"

namespace tcm_icp {

/// The scans that overlap least with the rest of their group, summed over the pairs that agree: the ends of a chain,
/// the border of an area. One of each group, the largest first, then the next of each, until there are `count`;
/// ascending.
/// @param groups  clear_groups() of the components
std::vector<std::size_t> margins_of_groups(const PairGraph& graph, const std::vector<Component>& components,
                                           const std::vector<std::size_t>& groups, std::size_t count);

}  // namespace tcm_icp
