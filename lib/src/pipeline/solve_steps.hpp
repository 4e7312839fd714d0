#pragma once
// The long steps of the solution, with a work folder: taken from there where they are, else done and kept.

#include <Eigen/Geometry>
#include <vector>

#include "adjustment/adjustment.hpp"
#include "inference/compared_pairs.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/merging/merge_options.hpp"
#include "tcm_icp/merging/merge_record.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// merge_in_tcm_order() of scans that have digests; without a store it is just that.
std::vector<MergeRecord> merge_once(const StepStore* store, const std::vector<PreparedScan>& scans,
                                    const PairGraph& graph, const MergeOptions& options, const RunContext& context,
                                    Component& component);

/// adjust_poses(), likewise.
AdjustmentRecord adjust_once(const StepStore* store, const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                             std::size_t reference, const Resolutions& resolutions, const AdjustmentOptions& options,
                             const L1FitOptions& lp, const RunContext& context,
                             std::vector<Eigen::Isometry3d>& T_reference_scan, StartingPoses from);

}  // namespace tcm_icp
