#pragma once
// Joint adjustment: all placed scans moved together at the fine resolution, over all pairs that overlap.

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"

namespace tcm_icp {

using ScanPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Pairs (a < b) of placed scans of which one has at least `min_overlap` of its points near the other.
ScanPairs overlapping_pairs(const std::vector<PreparedScan>& scans,
                            const std::vector<Eigen::Isometry3d>& T_reference_scan, const std::vector<bool>& placed,
                            double min_overlap, int num_threads);

/// Gauss-Newton on all poses at once: minimises the sum over all pairs, in both directions, of Huber's rho of the
/// distance to the plane at the nearest point; six unknowns a scan, the reference fixed, sparse Cholesky. Neighbours
/// are found anew before each step, within a gate that shrinks from twice the coarse to twice the fine resolution. Each
/// scan's error is shared among its links, so it does not pile up along a chain as in merging one by one.
/// @return rms move [m] of the scans' middles in the last step
/// Cost: one nearest-neighbour query a point and pair and step.
double adjust_poses(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                    const Resolutions& resolutions, const PlacementOptions& options, const RunContext& context,
                    std::vector<Eigen::Isometry3d>& T_reference_scan);

}  // namespace tcm_icp
