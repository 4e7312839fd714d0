#pragma once
// Random draws of points that depend on where points are, not on their indices: bottom-k sampling over hashed places
// (Cohen and Kaplan, Summarizing data using bottom-k sketches, 2007). A point more or less changes one draw, where
// drawn indices would shift for all points after it; so scans that differ by a rounding are sampled alike.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

/// A number for each point, uniform in 64 bits: a hash of the voxel it lies in and of one number of `rng`. Points of
/// one voxel share it, so `voxel_size_m` is the one that the points were sampled with (or less). O(N).
std::vector<std::uint64_t> place_priorities(const Points& points, double voxel_size_m, Rng& rng);

/// Those of `indices` with the `count` least priorities, in ascending order of index; all where there are no more.
/// Equal priorities go by index. O(N log N).
std::vector<std::size_t> least_priorities(std::vector<std::size_t> indices, std::span<const std::uint64_t> priorities,
                                          std::size_t count);

/// All indices, by priority: the order of a random draw without replacement.
std::vector<std::size_t> draw_order(std::span<const std::uint64_t> priorities);

}  // namespace tcm_icp
