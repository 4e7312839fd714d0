#pragma once
// The coarse start of conventional ICP: centroids and principal axes brought together.

#include <Eigen/Geometry>
#include <array>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

/// The four rigid motions that bring centroid and principal axes of `source` onto those of `target`: axes have no
/// sign, and of the eight combinations four are rotations. Which of the four comes first means nothing.
/// @throws InvalidInput  if a cloud is empty
/// @note Where variances are equal (a sphere, a square seen along its normal) the axes are arbitrary. O(N + M).
std::array<Eigen::Isometry3d, 4> principal_axes_alignments(const Points& target, const Points& source);

/// Mean distance [m] of the source's points, moved, to the nearest target point; NaN where there are none. O(N log M).
double mean_nearest_distance(const Points& source, const NeighborIndex& target,
                             const Eigen::Isometry3d& T_target_source);

/// Of those four the one with the least mean distance.
Eigen::Isometry3d coarse_alignment_by_axes(const Points& target, const NeighborIndex& target_index,
                                           const Points& source);

}  // namespace tcm_icp
