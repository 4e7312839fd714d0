#pragma once
// Joint adjustment: all placed scans moved together at the fine resolution, over all pairs that overlap.

#include <Eigen/Geometry>
#include <vector>

#include "adjustment/joint_matches.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/adjustment/adjustment_options.hpp"
#include "tcm_icp/adjustment/adjustment_record.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/registration/l1_fit.hpp"

namespace tcm_icp {

/// Pairs (a < b) of placed scans of which one has at least `min_overlap` of its points near the other: of each scan the
/// eight it shares most with, since more of them say the same again.
ScanPairs overlapping_pairs(const std::vector<PreparedScan>& scans,
                            const std::vector<Eigen::Isometry3d>& T_reference_scan, const std::vector<bool>& placed,
                            double min_overlap, int num_threads);

/// Where adjust_poses() begins.
enum class StartingPoses {
  kInferred,
  kAdjusted,  ///< over other pairs, most of them the same: least squares need no wide gate
};

/// All poses at once, the reference fixed, over all pairs in both directions; neighbours are found anew before each
/// step at the fine resolution. First options.lp_steps linear programs (solve_joint_lp), which a
/// minority of wrong matches does not move; the gate shrinks from twice the coarse to twice the fine resolution. Then
/// options.steps of Gauss-Newton with Huber's weights and sparse Cholesky, which are more exact where the errors are
/// nearly normal; where no program was solved, the gate shrinks in them. Each scan's error is shared among its links,
/// so it does not pile up along a chain as in merging one by one.
/// Cost: one nearest-neighbour query a point and pair and step, and the programs.
AdjustmentRecord adjust_poses(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                              const Resolutions& resolutions, const AdjustmentOptions& options, const L1FitOptions& lp,
                              const RunContext& context, std::vector<Eigen::Isometry3d>& T_reference_scan,
                              StartingPoses from = StartingPoses::kInferred);

}  // namespace tcm_icp
