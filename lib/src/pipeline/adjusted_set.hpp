#pragma once
// Scans that were merged, moved together and judged again: what a merge let pass may not pass here.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "adjustment.hpp"
#include "pose_graph.hpp"
#include "prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

/// One entry a scan of the whole set, members or not.
struct AdjustedSet {
  std::size_t reference = 0;
  std::vector<bool> placed;
  std::vector<Eigen::Isometry3d> T_reference_scan;  ///< local frames
  std::vector<std::optional<AlignmentEvidence>> evidence;
  std::vector<FreeSpaceEvidence> free_space;  ///< each against its neighbours, together
  std::vector<std::string> reasons;
  /// What the link to a group's cloud says of a scan that joined by it (group_joining.hpp), beside links between scans.
  std::vector<double> group_log_odds;
  ScanPairs pairs;                                     ///< of members that overlap
  std::vector<FreeSpaceEvidence> free_space_of_pairs;  ///< one for each of `pairs`
  AdjustmentRecord adjustment;                         ///< the last
  std::vector<LinkRecord> links;                       ///< one for each of `pairs`
  JointUncertainty uncertainty;                        ///< in the reference's local frame

  std::size_t num_placed() const;
};

/// Of `num_scans` scans, one alone, in its own local frame.
AdjustedSet set_of_one(std::size_t scan, std::size_t num_scans);

/// Adjusts all poses jointly, then judges each against all its neighbours, and takes out one scan at a time, the one
/// that most is seen through, where that is too much, else the one whose links speak least for it (or, without links,
/// that agrees least), because a wrong neighbour spoils the evidence of right ones; again until all pass. What the
/// merges found out about other poses (runner_up, searched) stays true: `set.evidence` brings it. Where the user named
/// no reference, the member with the most overlapping pairs becomes it, and the one before is judged like the others.
void adjust_and_verify(const std::vector<PreparedScan>& scans, const PoseGraph& graph, const Resolutions& resolutions,
                       const PipelineOptions& options, const RunContext& context, AdjustedSet& set);

}  // namespace tcm_icp
