#pragma once
// Samples that do not let the largest surface outvote the others.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Indices of about `count` points that have a normal, in ascending order; all of them where there are no more. Normals
/// are sorted into 48 directions (sign ignored); a direction's share grows with the square root of its number of
/// points, so that flat ground keeps a say but not the last word (after Rusinkiewicz and Levoy, 2001, who give all
/// directions the same). Of a direction's points those with the least priorities are drawn.
/// @param priorities  of place_priorities(), one a point
std::vector<std::size_t> normal_space_sample(const Cloud& cloud, std::size_t count,
                                             std::span<const std::uint64_t> priorities);

}  // namespace tcm_icp
