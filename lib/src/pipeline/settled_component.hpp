#pragma once
// A component after the joint adjustment: measured, decided, and rid of members whose place is not sure enough.

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "adjustment/joint_matches.hpp"
#include "inference/compared_pairs.hpp"
#include "links/hypotheses.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/decision/scan_decision.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

struct SettledComponent {
  Component component;
  ScanPairs pairs;                ///< of members that overlap, as adjusted
  std::vector<LinkRecord> links;  ///< one for each of `pairs`
  /// Of every scan of the set that is or was a member, at the last poses it was judged at.
  std::vector<std::optional<ScanMeasurements>> measurements;
  std::vector<Decision> decisions;
  AdjustmentRecord adjustment;
  JointUncertainty uncertainty;  ///< in the reference's local frame
};

/// Adjusts all poses jointly, measures and decides, and takes out what is least sure, one scan at a time, or a group
/// whose place is ambiguous as a whole, because a wrong neighbour spoils what is measured of right ones; again until
/// all that are left pass. The reference is judged like the others; where the user named none, the member with the most
/// overlapping pairs becomes it before anything is judged, for a decision is about where a scan lies to the reference.
/// @param steps  has the adjustments that were done before; nullptr: nothing is kept
SettledComponent settle(const std::vector<PreparedScan>& scans, const HypothesisSet& hypotheses, const PairGraph& graph,
                        const Resolutions& resolutions, const PipelineOptions& options, const RunContext& context,
                        Component component, const StepStore* steps = nullptr);

}  // namespace tcm_icp
