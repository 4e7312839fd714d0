#include "adjusted_set.hpp"

#include <algorithm>
#include <cmath>

#include "link_score.hpp"
#include "link_verification.hpp"
#include "linked_pairs.hpp"
#include "scan_set.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "verdict.hpp"

namespace tcm_icp {
namespace {

bool weaker(const AdjustedSet& set, std::size_t i, std::size_t j) {
  const FreeSpaceEvidence &free_i = set.free_space[i], &free_j = set.free_space[j];
  if (free_i.vetoes() || free_j.vetoes()) return free_i.excess() > free_j.excess();
  const AlignmentEvidence &a = *set.evidence[i], &b = *set.evidence[j];
  const bool linked = !std::isnan(a.link_log_odds) && !std::isnan(b.link_log_odds);
  return linked && a.link_log_odds != b.link_log_odds ? a.link_log_odds < b.link_log_odds
                                                      : a.consensus() < b.consensus();
}

// Of the members but the reference: the lower median, so that of two the better counts.
double typical_residual_m(const AdjustedSet& set) {
  std::vector<double> residuals_m;
  for (std::size_t i = 0; i < set.placed.size(); ++i) {
    if (set.placed[i] && i != set.reference) residuals_m.push_back(set.evidence[i]->median_residual_m);
  }
  if (residuals_m.empty()) return 0;
  const auto middle = residuals_m.begin() + static_cast<std::ptrdiff_t>((residuals_m.size() - 1) / 2);
  std::nth_element(residuals_m.begin(), middle, residuals_m.end());
  return *middle;
}

// A scan that joined a group by what the group's cloud says, while its links to members say little: asked for more,
// like a pose that a wide search came up with. Free space takes away what contradicted a mirrored scan of a hall, and
// leaves it one pose, with 0.67.
constexpr double kMaxLeftByGroupAlone = 0.55;

bool holds_by_group_alone(const AdjustedSet& set, std::size_t i) {
  const double by_links = set.evidence[i]->link_log_odds - set.group_log_odds[i];
  return set.group_log_odds[i] > 0 && by_links < kMinLinkLogOdds;
}

/// Fills in the evidence of all members; returns the weakest of those that fail.
std::optional<std::size_t> verify_members(const std::vector<PreparedScan>& scans, const PoseGraph& graph,
                                          const RunContext& context, AdjustedSet& set) {
  context.report("verifying", 0, 1);
  set.free_space_of_pairs = free_space_of_pairs(scans, set.pairs, set.T_reference_scan, context.num_threads);
  set.free_space = free_space_of_neighbors(scans.size(), set.pairs, set.free_space_of_pairs);
  parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!set.placed[i] || i == set.reference) continue;
      const AlignmentEvidence at_merge = *set.evidence[i];
      set.evidence[i] = verify_against_neighbors(scans, set.pairs, i, set.T_reference_scan);
      set.evidence[i]->runner_up = at_merge.runner_up;
      set.evidence[i]->searched = at_merge.searched;
      if (std::isnan(at_merge.link_log_odds)) continue;
      const PointMoments& points = scans[i].moments;
      const StartPose support = graph.support(i, set.placed, set.T_reference_scan, points,
                                              kSameLinkPose * scans[i].pyramid.level(0).voxel_size_m);
      set.evidence[i]->link_log_odds = support.log_odds + set.group_log_odds[i];
      set.evidence[i]->num_links = support.num_links;
    }
  });
  const double typical_m = typical_residual_m(set);
  std::vector<bool> by_group_alone(scans.size(), false);
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!set.placed[i] || i == set.reference) continue;
    by_group_alone[i] = holds_by_group_alone(set, i);
    set.evidence[i]->link_log_odds += misfit_log_odds(set.evidence[i]->median_residual_m, typical_m);
    Verdict verdict = judge(*set.evidence[i], set.free_space[i]);
    if (verdict.accepted && by_group_alone[i] && set.evidence[i]->left_after_slide[0] > kMaxLeftByGroupAlone) {
      verdict = {false, "ambiguous: no link to a single scan bears out its place in the group, and it slides"};
    }
    set.reasons[i] = verdict.reason;
    if (verdict.accepted) continue;
    if (!worst || weaker(set, i, *worst)) worst = i;
  }
  return worst;
}

// The member with the most verified links: the graph that chose the first reference knew guesses only, and errors grow
// with the distance from it.
std::size_t best_reference(const AdjustedSet& set) {
  std::vector<std::vector<std::size_t>> adjacency(set.placed.size());
  for (const auto& [a, b] : set.pairs) {
    adjacency[a].push_back(b);
    adjacency[b].push_back(a);
  }
  const std::size_t best = choose_reference(adjacency);
  return adjacency[best].size() > adjacency[set.reference].size() ? best : set.reference;
}

void move_reference(std::size_t to, const std::vector<PreparedScan>& scans, const PoseGraph& graph, AdjustedSet& set) {
  const Eigen::Isometry3d T_new_old = set.T_reference_scan[to].inverse();
  for (Eigen::Isometry3d& T : set.T_reference_scan) T = T_new_old * T;
  set.T_reference_scan[to].setIdentity();
  set.evidence[to].reset();
  set.reasons[to].clear();
  AlignmentEvidence& evidence = set.evidence[set.reference].emplace();
  evidence.runner_up = 0;  // no fit of its own whose neighbourhood could be explored
  const StartPose support = graph.support(set.reference, set.placed, set.T_reference_scan, scans[set.reference].moments,
                                          kSameLinkPose * scans[set.reference].pyramid.level(0).voxel_size_m);
  if (support.log_odds >= kMinLinkLogOdds) evidence.link_log_odds = support.log_odds;  // else by a guess
  set.reference = to;
}

}  // namespace

std::size_t AdjustedSet::num_placed() const {
  return static_cast<std::size_t>(std::count(placed.begin(), placed.end(), true));
}

AdjustedSet set_of_one(std::size_t scan, std::size_t num_scans) {
  AdjustedSet set;
  set.reference = scan;
  set.placed.assign(num_scans, false);
  set.placed[scan] = true;
  set.T_reference_scan.assign(num_scans, Eigen::Isometry3d::Identity());
  set.evidence.assign(num_scans, std::nullopt);
  set.free_space.assign(num_scans, {});
  set.reasons.assign(num_scans, "no link to another scan was found");
  set.group_log_odds.assign(num_scans, 0);
  return set;
}

void adjust_and_verify(const std::vector<PreparedScan>& scans, const PoseGraph& graph, const Resolutions& resolutions,
                       const PipelineOptions& options, const RunContext& context, AdjustedSet& set) {
  while (true) {
    set.pairs = without_unlinked(
        scans, graph, set.T_reference_scan,
        overlapping_pairs(scans, set.T_reference_scan, set.placed, kMinLinkOverlap, context.num_threads));
    set.adjustment = adjust_poses(scans, set.pairs, set.reference, resolutions, options, context, set.T_reference_scan);
    std::optional<std::size_t> worst = verify_members(scans, graph, context, set);
    if (const std::size_t best = best_reference(set); !worst && options.reference.empty() && best != set.reference) {
      move_reference(best, scans, graph, set);
      worst = verify_members(scans, graph, context, set);  // the old reference had not been judged
    }
    if (!worst) return;
    set.placed[*worst] = false;
  }
}

}  // namespace tcm_icp
