#pragma once
// All neighbours within one radius of all points of a cloud, by a grid: many times faster than asking a tree for each.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Neighbours of point i: the entries from `first[i]` up to `first[i + 1]`, without i itself. Their order depends on
/// the points alone.
struct RadiusNeighbors {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> index;

  std::span<const std::uint32_t> of(std::size_t i) const {
    return {index.data() + first[i], index.data() + first[i + 1]};
  }
};

/// @param points    finite [m]
/// @param radius_m  > 0
/// O(N k), k neighbours each.
RadiusNeighbors radius_neighbors(const Points& points, double radius_m);

}  // namespace tcm_icp
