#pragma once
// Registration by a conventional method: all pairs, a spanning tree, poses along it. To compare TCM-ICP with.

#include <filesystem>
#include <string>
#include <vector>

#include "tcm_icp/baselines/pair_fit.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"

namespace tcm_icp {

/// Registers the scans by `method`, one of whose name is reported. Files are read, sampled and, where the options ask
/// for it, rid of outliers as in Pipeline::run; the method sees one point a fine voxel of each scan. Every scan is
/// registered: a conventional method has no verdict. Whether its pair converged stands in the reason and the report.
/// @param initial_poses  one a scan; a pair starts from them where both its scans have one
/// @throws InputError, InvalidInput, InvalidOptions, Cancelled  as Pipeline::run
PipelineResult register_by_pairs(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses,
                                 const PipelineOptions& options, const RunContext& context, const std::string& name,
                                 const PairMethod& method);

}  // namespace tcm_icp
