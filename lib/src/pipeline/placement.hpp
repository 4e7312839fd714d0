#pragma once
// Placing one scan against the merged cloud: simplex, descent, annealing, verification.

#include <Eigen/Geometry>

#include "placer.hpp"
#include "pose_graph.hpp"
#include "prepared_scan.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// Fills `record` but for scan, attempt and tcm; returns the pose found, right or not: record.accepted tells.
///
/// The linear programs start from gates of 8, 16, 4 and 32 coarse voxels in turn, because nothing tells how far off the
/// initial guess is; the first that passes verification ends the turn, otherwise the one with the largest consensus
/// counts. If none passes, shifts of the initial guess are tried, then annealing searches from it, and the programs
/// start again from what it finds. Then other poses nearby are tried (pose_search.hpp): the largest consensus wins, and
/// a close runner-up makes the pose ambiguous. A pose that `free_space` vetoes does not pass; as another pose it
/// counts.
Eigen::Isometry3d place_scan(const PreparedScan& scan, const ScanPyramid& merged, const Eigen::Isometry3d& T_init,
                             const PipelineOptions& options, Rng& rng, MergeRecord& record,
                             const FreeSpaceCheck& free_space = {});

/// The same from poses that links lead to, in their order: the fits start near, from gates of 4 and 8 voxels; up to
/// three of them are tried, fewer where one passes and the next ones' links say clearly less. No search beyond other
/// poses nearby.
Eigen::Isometry3d place_linked_scan(const PreparedScan& scan, const ScanPyramid& merged,
                                    const std::vector<StartPose>& starts, const PipelineOptions& options, Rng& rng,
                                    MergeRecord& record, const FreeSpaceCheck& free_space = {});

/// The paper's way: simplex over all nearest neighbours in 12 entries, descent and annealing on tau, no verification.
Eigen::Isometry3d place_scan_as_printed(const PreparedScan& scan, const ScanPyramid& merged,
                                        const Eigen::Isometry3d& T_init, const PipelineOptions& options, Rng& rng,
                                        MergeRecord& record);

/// The refinement's own options with steps from the data.
DescentOptions descent_options(const RefinementOptions& options, double first_step_m, double last_step_m);
AnnealingOptions annealing_options(const RefinementOptions& options, double first_step_m, double last_step_m);

}  // namespace tcm_icp
