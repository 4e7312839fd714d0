#pragma once
// All placed scans moved together at the fine resolution, each against all its neighbours.

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"

namespace tcm_icp {

/// Pairs (a < b) of placed scans of which one has at least `min_overlap` of its points near the other.
std::vector<std::pair<std::size_t, std::size_t>> overlapping_pairs(
    const std::vector<PreparedScan>& scans, const std::vector<Eigen::Isometry3d>& T_reference_scan,
    const std::vector<bool>& placed, double min_overlap, int num_threads);

/// Passes over the scans but the reference: one L1 program a scan over its correspondences with every neighbour, at the
/// neighbours' present poses, with a gate that shrinks from pass to pass (block coordinate descent on the joint problem).
void adjust_poses(const std::vector<PreparedScan>& scans,
                  const std::vector<std::pair<std::size_t, std::size_t>>& pairs, std::size_t reference,
                  const Resolutions& resolutions, const PipelineOptions& options, const RunContext& context,
                  std::vector<Eigen::Isometry3d>& T_reference_scan);

}  // namespace tcm_icp
