#include "adjusted_set.hpp"

#include <algorithm>
#include <cmath>

#include "link_verification.hpp"
#include "scan_set.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "verdict.hpp"

namespace tcm_icp {
namespace {

bool weaker(const AlignmentEvidence& a, const AlignmentEvidence& b) {
  const bool linked = !std::isnan(a.link_log_odds) && !std::isnan(b.link_log_odds);
  return linked && a.link_log_odds != b.link_log_odds ? a.link_log_odds < b.link_log_odds
                                                      : a.consensus() < b.consensus();
}

/// Fills in the evidence of all members; returns the one that agrees least among those that fail.
std::optional<std::size_t> verify_members(const std::vector<PreparedScan>& scans, const PoseGraph& graph,
                                          const RunContext& context, AdjustedSet& set) {
  context.report("verifying", 0, 1);
  parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!set.placed[i] || i == set.reference) continue;
      const AlignmentEvidence at_merge = *set.evidence[i];
      set.evidence[i] = verify_against_neighbors(scans, set.pairs, i, set.T_reference_scan);
      set.evidence[i]->runner_up = at_merge.runner_up;
      set.evidence[i]->searched = at_merge.searched;
      if (std::isnan(at_merge.link_log_odds)) continue;
      const Points& points = scans[i].held_out_sample.points;
      const StartPose support = graph.support(i, set.placed, set.T_reference_scan, points,
                                              kSameLinkPose * scans[i].pyramid.level(0).voxel_size_m);
      set.evidence[i]->link_log_odds = support.log_odds;
      set.evidence[i]->num_links = support.num_links;
    }
  });
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!set.placed[i] || i == set.reference) continue;
    const Verdict verdict = judge(*set.evidence[i]);
    set.reasons[i] = verdict.reason;
    if (verdict.accepted) continue;
    if (!worst || weaker(*set.evidence[i], *set.evidence[*worst])) worst = i;
  }
  return worst;
}

}  // namespace

std::size_t AdjustedSet::num_placed() const {
  return static_cast<std::size_t>(std::count(placed.begin(), placed.end(), true));
}

void adjust_and_verify(const std::vector<PreparedScan>& scans, const PoseGraph& graph, const Resolutions& resolutions,
                       const PipelineOptions& options, const RunContext& context, AdjustedSet& set) {
  while (true) {
    set.pairs = overlapping_pairs(scans, set.T_reference_scan, set.placed, kMinLinkOverlap, context.num_threads);
    set.adjustment = adjust_poses(scans, set.pairs, set.reference, resolutions, options, context, set.T_reference_scan);
    const std::optional<std::size_t> worst = verify_members(scans, graph, context, set);
    if (!worst) return;
    set.placed[*worst] = false;
  }
}

}  // namespace tcm_icp
