#include "placer.hpp"

#include <algorithm>

#include "link_score.hpp"
#include "placement.hpp"
#include "pose_search.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/alignment_objective.hpp"

namespace tcm_icp {
namespace {

constexpr double kExploreGate = 4;
constexpr double kCoarseFinalGate = 2, kFineFinalGate = 1.5;
constexpr int kMaxExplorations = 3;
// Most fits settle within 15 programs; the others go round in circles of nearly equal poses.
constexpr int kFitPrograms = 20, kExplorePrograms = 10;
// A look elsewhere takes one point in so many, and is carried on where it comes to this share of the consensus.
constexpr std::size_t kLookPart = 3;
constexpr double kPromisingShare = 0.5;

VerificationOptions consensus_only(VerificationOptions options) {
  options.with_slides = false;
  return options;
}

}  // namespace

bool better(const PlacementCandidate& a, const PlacementCandidate& b) {
  if (a.verdict.accepted != b.verdict.accepted) return a.verdict.accepted;
  return a.evidence.consensus() > b.evidence.consensus();
}

Placer::Placer(const PreparedScan& scan, const ScanPyramid& merged, const PipelineOptions& options,
               const FreeSpaceCheck& free_space)
    : scan_(scan),
      merged_(merged),
      options_(options),
      free_space_(free_space),
      voxel_m_(merged.level(0).voxel_size_m),
      coarse_look_(even_sample(scan.coarse_sample, scan.coarse_sample.size() / kLookPart)),
      fine_look_(even_sample(scan.fit_sample, scan.fit_sample.size() / kLookPart)) {}

AlignmentEvidence Placer::verify(const Eigen::Isometry3d& T) const {
  return verify_alignment(scan_.held_out_sample, merged_.level(0), T, verification_at(voxel_m_));
}

Verdict Placer::judge_at(const Eigen::Isometry3d& T, const AlignmentEvidence& evidence) const {
  const Verdict verdict = judge(evidence);
  // Free space takes time: it is not asked where it would not change anything.
  const bool may_change = verdict.accepted || may_be_held_across(evidence);
  return free_space_ && may_change ? judge(evidence, free_space_(T)) : verdict;
}

FreeSpaceEvidence Placer::free_space_of(const PlacementCandidate& candidate) const {
  return free_space_ ? free_space_(candidate.fit.T_target_source) : FreeSpaceEvidence{};
}

PlacementCandidate Placer::fit_from(const Eigen::Isometry3d& T_init, std::span<const double> gates) {
  PlacementCandidate best;
  for (const double gate : gates) {
    const PlacementCandidate candidate = fit_and_verify(T_init, gate);
    if (!best.found || (candidate.found && better(candidate, best))) best = candidate;
    if (best.verdict.accepted) break;
  }
  return best;
}

void Placer::try_shifts(const Eigen::Isometry3d& T_init, double gate_in_voxels, PlacementCandidate& best) {
  for (const auto& T : other_minima(scan_.coarse_sample, scan_.held_out_sample, merged_, T_init)) {
    const PlacementCandidate candidate = fit_and_verify(T, gate_in_voxels);
    if (candidate.found && (!best.found || better(candidate, best))) best = candidate;
  }
}

void Placer::explore(PlacementCandidate& best) {
  double runner_up = 0;
  bool changed = true;
  FreeSpaceEvidence best_free = free_space_of(best);
  // More agrees along a corridor the more two scans overlap: there a pose that free space speaks against is no rival.
  // Elsewhere it shows that the place repeats itself.
  const bool corridor = best.evidence.left_after_slide[0] > kMaxLeftAfterSlide && held_across(best.evidence, best_free);
  for (int round = 0; changed && round < kMaxExplorations; ++round) {
    changed = false;
    const Eigen::Isometry3d T_round = best.fit.T_target_source;
    for (const auto& T : other_minima(scan_.coarse_sample, scan_.held_out_sample, merged_, T_round)) {
      const PlacementCandidate other = look_at(T, best);
      if (!other.found || same_pose(other, best)) continue;
      const double mine = best.evidence.consensus(), others = other.evidence.consensus();
      const bool promising = others > kPromisingShare * mine;
      const FreeSpaceEvidence other_free = promising ? free_space_of(other) : FreeSpaceEvidence{};
      const double lead = free_space_log_odds(best_free) - free_space_log_odds(other_free);
      if (promising && corridor && (other_free.vetoes() || lead > kClearLogOdds)) continue;
      const bool wins = others > mine || (promising && best_free.vetoes());
      if (wins && !other_free.vetoes()) {
        runner_up = mine / others;
        best = other;
        changed = true, best_free = other_free;
      } else if (mine > 0) {
        runner_up = std::max(runner_up, others / mine);
      }
    }
  }
  best.evidence.runner_up = runner_up;
}

void Placer::refine(PlacementCandidate& candidate, Rng& rng, MergeRecord& record) const {
  const RefinementOptions& o = options_.refinement;
  const auto count = static_cast<std::size_t>(o.points);
  const Cloud fit = even_sample(scan_.fit_sample, count), kept = even_sample(scan_.held_out_sample, count);
  // The fit's own residual is the noise; a voxel's hundredth keeps perfect data from a scale of zero.
  const double noise_m = std::max(candidate.fit.median_residual_m, voxel_m_ / 100);
  const AlignmentObjective objective(fit, merged_.level(0), 2 * noise_m, 2 * voxel_m_);
  const AlignmentObjective held_out_objective(kept, merged_.level(0), 2 * noise_m, 2 * voxel_m_);
  const PoseCost cost = [&](const Eigen::Isometry3d& T) { return objective.cost(T); };
  const PoseCost held_out = [&](const Eigen::Isometry3d& T) { return held_out_objective.cost(T); };
  Eigen::Isometry3d& T = candidate.fit.T_target_source;
  const TwistFrame frame = twist_frame(fit.points, T);
  if (o.method == Refinement::kDescent || o.method == Refinement::kDescentThenAnnealing) {
    const PoseGradient gradient = [&](const Eigen::Isometry3d& pose, Twist& slope) {
      return objective.cost_and_gradient(pose, frame.centre, slope);
    };
    record.descent = descend(cost, gradient, held_out, frame, T, descent_options(o, noise_m / 2, noise_m / 64));
    T = record.descent->T_target_source;
  }
  if (o.method == Refinement::kAnnealing || o.method == Refinement::kDescentThenAnnealing) {
    record.annealing = anneal(cost, held_out, frame, T, annealing_options(o, noise_m / 2, noise_m / 32), rng);
    T = record.annealing->T_target_source;
  }
}

PlacementCandidate Placer::fit_and_verify(const Eigen::Isometry3d& T_init, double gate_in_voxels) {
  PlacementCandidate candidate;
  const RegistrationResult coarse = fit_coarse(scan_.coarse_sample, T_init, gate_in_voxels * voxel_m_, kFitPrograms);
  candidate.fit = coarse.usable() ? fit_fine(scan_.fit_sample, coarse, kFitPrograms) : coarse;
  candidate.found = candidate.fit.usable();
  if (!candidate.found) return candidate;
  candidate.evidence = verify(candidate.fit.T_target_source);
  candidate.verdict = judge_at(candidate.fit.T_target_source, candidate.evidence);
  return candidate;
}

// A fit from another pose, of which only the consensus is wanted: ends as soon as it comes to `best`, or promises to
// stay far below it.
PlacementCandidate Placer::look_at(const Eigen::Isometry3d& T_init, const PlacementCandidate& best) {
  PlacementCandidate other;
  other.fit = fit_coarse(coarse_look_, T_init, kExploreGate * voxel_m_, kExplorePrograms);
  if (!other.fit.usable() || same_pose(other, best)) return other;
  for (const bool hasty : {true, false}) {
    other.fit = fit_fine(hasty ? fine_look_ : scan_.fit_sample, other.fit, hasty ? kExplorePrograms : kFitPrograms);
    other.found = other.fit.usable();
    if (!other.found || same_pose(other, best)) break;
    other.evidence = verify_alignment(scan_.held_out_sample, merged_.level(0), other.fit.T_target_source,
                                      consensus_only(verification_at(voxel_m_)));
    if (other.evidence.consensus() < kPromisingShare * best.evidence.consensus()) break;
  }
  return other;
}

// Programs over every kind of point, then finer ones over surfaces.
RegistrationResult Placer::fit_coarse(const Cloud& points, const Eigen::Isometry3d& T_init, double gate_m,
                                      int max_programs) {
  const LpRegistrationOptions lp = lp_options(gate_m, kCoarseFinalGate * voxel_m_, max_programs);
  const RegistrationResult fit = register_lp(points, merged_, T_init, lp);
  figures_ += fit.lp;
  return fit;
}

RegistrationResult Placer::fit_fine(const Cloud& surfaces, const RegistrationResult& before, int max_programs) {
  LpRegistrationOptions lp = lp_options(kCoarseFinalGate * voxel_m_, kFineFinalGate * voxel_m_, max_programs);
  lp.initial_normal_angle_deg = lp.final_normal_angle_deg;
  RegistrationResult fit = register_lp(surfaces, merged_, before.T_target_source, lp);
  figures_ += fit.lp;
  fit.num_iterations += before.num_iterations;
  return fit;
}

LpRegistrationOptions Placer::lp_options(double initial_gate_m, double final_gate_m, int max_programs) const {
  LpRegistrationOptions lp;
  lp.formulation = options_.placement.formulation;
  lp.lp = options_.lp;
  lp.initial_gate_m = initial_gate_m;
  lp.final_gate_m = final_gate_m;
  lp.max_iterations = max_programs;
  return lp;
}

bool Placer::same_pose(const PlacementCandidate& a, const PlacementCandidate& b) const {
  const Eigen::Isometry3d apart = a.fit.T_target_source.inverse() * b.fit.T_target_source;
  return rms_displacement(apart, scan_.held_out_sample.points) < kSearchGridStep / 2 * voxel_m_;
}

}  // namespace tcm_icp
