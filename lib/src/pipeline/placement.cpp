#include "placement.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "link_score.hpp"
#include "placer.hpp"
#include "pose_search.hpp"

namespace tcm_icp {

DescentOptions descent_options(const RefinementOptions& options, double first_step_m, double last_step_m) {
  DescentOptions descent;
  descent.initial_step_m = first_step_m;
  descent.min_step_m = last_step_m;
  descent.max_steps = options.descent_steps;
  return descent;
}

AnnealingOptions annealing_options(const RefinementOptions& options, double first_step_m, double last_step_m) {
  AnnealingOptions annealing;
  annealing.initial_step_m = first_step_m;
  annealing.final_step_m = last_step_m;
  annealing.num_steps = options.annealing_steps;
  annealing.initial_temperature = options.initial_temperature;
  annealing.final_temperature = options.final_temperature;
  return annealing;
}

namespace {

// First gates of the linear programs, in coarse voxels, in the order they are tried; then from poses the search found.
constexpr std::array kGateLadder{8.0, 16.0, 4.0, 32.0};
constexpr std::array kLinkGates{4.0, 8.0};
constexpr std::size_t kMaxStarts = 3;
// After a start that passes, others whose links say less by this much are left alone.
constexpr double kClearLead = kClearLogOdds;
constexpr std::size_t kMinSamplePoints = 30;

bool too_small(const PreparedScan& scan, MergeRecord& record) {
  if (std::min(scan.coarse_sample.size(), scan.held_out_sample.size()) >= kMinSamplePoints) return false;
  record.simplex.termination = Termination::kTooFewCorrespondences;
  record.reason = "too few of its points lie on surfaces";
  return true;
}

// What follows once a fit was found: other poses nearby, refinement, judgement.
Eigen::Isometry3d finish(Placer& placer, PlacementCandidate& best, const Eigen::Isometry3d& T_init, Rng& rng,
                         MergeRecord& record) {
  if (best.found) placer.explore(best);
  record.simplex = best.fit;
  record.simplex.lp = placer.figures();
  if (!best.found) {
    record.reason = "the simplex step found no pose: " + std::string(to_string(best.fit.termination));
    return T_init;
  }
  placer.refine(best, rng, record);
  record.evidence = placer.verify(best.fit.T_target_source);
  record.evidence->runner_up = best.evidence.runner_up;
  record.evidence->searched = record.searched;
  const Verdict verdict = placer.judge_at(best.fit.T_target_source, *record.evidence);
  record.accepted = verdict.accepted;
  record.reason = verdict.reason;
  return best.fit.T_target_source;
}

}  // namespace

Eigen::Isometry3d place_linked_scan(const PreparedScan& scan, const ScanPyramid& merged,
                                    const std::vector<StartPose>& starts, const PipelineOptions& options, Rng& rng,
                                    MergeRecord& record, const FreeSpaceCheck& free_space) {
  const Eigen::Isometry3d& T_first = starts.front().T_reference_scan;
  if (too_small(scan, record)) return T_first;
  Placer placer(scan, merged, options, free_space);
  PlacementCandidate best;
  for (std::size_t k = 0; k < std::min(starts.size(), kMaxStarts); ++k) {
    if (best.verdict.accepted && starts[k].log_odds < starts[0].log_odds - kClearLead) break;
    // What more speaks against than for would win by agreement alone: along a corridor, where scans overlap most.
    if (k > 0 && starts[k].log_odds <= 0) break;
    const PlacementCandidate candidate = placer.fit_from(starts[k].T_reference_scan, kLinkGates);
    if (candidate.found && (!best.found || better(candidate, best))) best = candidate;
  }
  return finish(placer, best, T_first, rng, record);
}

Eigen::Isometry3d place_scan(const PreparedScan& scan, const ScanPyramid& merged, const Eigen::Isometry3d& T_init,
                             const PipelineOptions& options, Rng& rng, MergeRecord& record,
                             const FreeSpaceCheck& free_space) {
  if (too_small(scan, record)) return T_init;
  Placer placer(scan, merged, options, free_space);
  PlacementCandidate best = placer.fit_from(T_init, kGateLadder);
  if (!best.verdict.accepted && options.placement.search_steps > 0) {
    record.searched = true;
    placer.try_shifts(T_init, kGateLadder[0], best);
  }
  if (!best.verdict.accepted && options.placement.search_steps > 0) {
    const Eigen::Isometry3d T =
        search_by_annealing(scan.coarse_sample, scan.held_out_sample, merged, T_init, options, rng);
    const PlacementCandidate found = placer.fit_from(T, kGateLadder);
    if (found.found && (!best.found || better(found, best))) best = found;
  }
  return finish(placer, best, T_init, rng, record);
}

}  // namespace tcm_icp
