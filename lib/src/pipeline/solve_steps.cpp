#include "pipeline/solve_steps.hpp"

#include "links/pair_steps.hpp"
#include "merging/merging.hpp"
#include "steps/do_once.hpp"
#include "steps/key_parts.hpp"

namespace tcm_icp {

// Each field by name, so that a field more does not compile before it is listed here.

template <typename Record, MaybeConst<LpFigures> T>
void transfer(Record& record, T& value) {
  auto& [num_programs, num_pivots, objective, gap, seconds] = value;
  record(num_programs, num_pivots, objective, gap, seconds);
}

template <typename Record, MaybeConst<RegistrationResult> T>
void transfer(Record& record, T& value) {
  auto& [T_target_source, termination, num_iterations, num_correspondences, residual_m, lp] = value;
  record(T_target_source, termination, num_iterations, num_correspondences, residual_m, lp);
}

template <typename Record, MaybeConst<RefinementTrace> T>
void transfer(Record& record, T& value) {
  auto& [T_target_source, num_steps, num_accepted, initial, final, initial_held_out, final_held_out, kept] = value;
  record(T_target_source, num_steps, num_accepted, initial, final, initial_held_out, final_held_out, kept);
}

template <typename Record, MaybeConst<TcmTerms> T>
void transfer(Record& record, T& value) {
  auto& [f, g, h] = value;
  record(f, g, h);
}

template <typename Record, MaybeConst<MergeRecord> T>
void transfer(Record& record, T& value) {
  auto& [scan, tcm, simplex, descent, annealing, accepted, reason] = value;
  record(scan, tcm, simplex, descent, annealing, accepted, reason);
}

template <typename Record, MaybeConst<Component> T>
void transfer(Record& record, T& value) {
  auto& [reference, T_reference_scan] = value;
  record(reference, T_reference_scan);
}

template <typename Record, MaybeConst<PoseHypothesis> T>
void transfer(Record& record, T& value) {
  auto& [T_a_b, log_odds, implied, overlap, weakest_left, taught, is_there, of_a, of_b, mean, telling, slid,
         most_support] = value;
  record(T_a_b, log_odds, implied, overlap, weakest_left, taught, is_there, of_a.points, of_a.violations, of_a.large,
         of_b.points, of_b.violations, of_b.large, mean, telling.missed, telling.shows, slid, most_support);
}

template <typename Record, MaybeConst<JudgedHypothesis> T>
void transfer(Record& record, T& value) {
  auto& [log_odds, right, sure] = value;
  record(log_odds, right, sure);
}

template <typename Record, MaybeConst<ComparedPair> T>
void transfer(Record& record, T& value) {
  auto& [a, b, hypotheses, teachers] = value;
  record(a, b, hypotheses, teachers);
}

template <typename Record, MaybeConst<InferenceOptions> T>
void transfer(Record& record, T& value) {
  auto& [poses, implied, missed, missed_there, telling, firm_left, loose_left, slid, twins, alike, spread,
         most_log_odds, set_spread, max_starts, max_grown, max_sweeps] = value;
  record(poses, implied, missed, missed_there, telling, firm_left, loose_left, slid, twins, alike, spread,
         most_log_odds, set_spread, max_starts, max_grown, max_sweeps);
}

template <typename Record, MaybeConst<RobustTcmOptions> T>
void transfer(Record& record, T& value) {
  auto& [quantile, max_samples] = value;
  record(quantile, max_samples);
}

template <typename Record, MaybeConst<RefinementOptions> T>
void transfer(Record& record, T& value) {
  auto& [method, points, descent_steps, annealing_steps, initial_temperature, final_temperature] = value;
  record(method, points, descent_steps, annealing_steps, initial_temperature, final_temperature);
}

template <typename Record, MaybeConst<PaperOptions> T>
void transfer(Record& record, T& value) {
  auto& [matches, kept_share, max_rounds, end, points, slack, unknowns, descent, marginal_share] = value;
  record(matches, kept_share, max_rounds, end, points, slack, unknowns, descent, marginal_share);
}

template <typename Record, MaybeConst<MergeOptions> T>
void transfer(Record& record, T& value) {
  auto& [order, paper_tcm, fits, tcm, formulation, lp, refinement, paper, correspondence_threshold_m] = value;
  record(order, paper_tcm, fits, tcm, formulation, lp, refinement, paper, correspondence_threshold_m);
}

template <typename Record, MaybeConst<AdjustmentRecord> T>
void transfer(Record& record, T& value) {
  auto& [lp, lp_status, num_lp_matches, lp_rms_move_m, num_steps, rms_move_m, bending_m, motion_m, outlying_pairs] =
      value;
  record(lp, lp_status, num_lp_matches, lp_rms_move_m, num_steps, rms_move_m, bending_m, motion_m, outlying_pairs);
}

namespace {

struct Merged {
  std::vector<MergeRecord> records;
  Component component;
};

template <typename Record, MaybeConst<Merged> T>
void transfer(Record& record, T& value) {
  auto& [records, component] = value;
  record(records, component);
}

struct Adjusted {
  AdjustmentRecord record;
  std::vector<Eigen::Isometry3d> T_reference_scan;
};

template <typename Record, MaybeConst<Adjusted> T>
void transfer(Record& record, T& value) {
  auto& [adjustment, T_reference_scan] = value;
  record(adjustment, T_reference_scan);
}

}  // namespace

std::vector<MergeRecord> merge_once(const StepStore* store, const std::vector<PreparedScan>& scans,
                                    const PairGraph& graph, const MergeOptions& options, const RunContext& context,
                                    Component& component) {
  if (store == nullptr) return merge_in_tcm_order(scans, graph, options, context, component);
  const StepKey key =
      step_key("merges", digests_of(scans), graph.pairs(), graph.options(), options, context.seed, component);
  auto merged = do_once<Merged>(*store, key, [&] {
    Component moved = component;
    auto records = merge_in_tcm_order(scans, graph, options, context, moved);
    return Merged{std::move(records), std::move(moved)};
  });
  component = std::move(merged.component);
  return std::move(merged.records);
}

AdjustmentRecord adjust_once(const StepStore* store, const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                             std::size_t reference, const Resolutions& resolutions, const AdjustmentOptions& options,
                             const L1FitOptions& lp, const RunContext& context,
                             std::vector<Eigen::Isometry3d>& T_reference_scan, StartingPoses from) {
  const auto adjust = [&](std::vector<Eigen::Isometry3d>& T) {
    return adjust_poses(scans, pairs, reference, resolutions, options, lp, context, T, from);
  };
  if (store == nullptr) return adjust(T_reference_scan);
  const auto& [lp_steps, steps, bending] = options;
  const StepKey key = step_key("adjustments", digests_of(scans), pairs, reference, lp_steps, steps, bending, lp,
                               T_reference_scan, from);
  auto adjusted = do_once<Adjusted>(*store, key, [&] {
    Adjusted out{{}, T_reference_scan};
    out.record = adjust(out.T_reference_scan);
    return out;
  });
  T_reference_scan = std::move(adjusted.T_reference_scan);
  return adjusted.record;
}

}  // namespace tcm_icp
