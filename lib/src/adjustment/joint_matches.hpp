#pragma once
// Matches over all pairs of scans, for what looks at all poses at once.

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "scans/prepared_scan.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// Gate of a match in voxels of the resolution it is looked for at.
constexpr double kGateInVoxels = 2;

/// Both directions of every pair at the fine resolution, in the pairs' order. A source with up to three neighbours
/// shows each its whole sample, one with up to six a half, others a third, and not the same part to each. Points of
/// opposite sides of a wall do not match, where scans know which they saw. One nearest-neighbour query a point.
std::vector<JointLink> match_pairs(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                   const std::vector<Eigen::Isometry3d>& T_reference_scan, double max_distance_m,
                                   int num_threads);

/// Rotations are taken about each scan's middle, by the arc at its radius.
std::vector<TwistFrame> scan_frames(const std::vector<PreparedScan>& scans,
                                    const std::vector<Eigen::Isometry3d>& T_reference_scan);

/// At most `max_matches` of each link, evenly spaced in their order.
std::vector<JointLink> thinned(std::vector<JointLink> links, std::size_t max_matches);

}  // namespace tcm_icp
