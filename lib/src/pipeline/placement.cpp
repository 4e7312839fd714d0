#include "placement.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "pose_search.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/alignment_objective.hpp"
#include "tcm_icp/registration/lp_registration.hpp"
#include "verdict.hpp"

namespace tcm_icp {
namespace {

// First gates of the linear programs, in coarse voxels, in the order they are tried; then from poses the search found.
constexpr std::array kGateLadder{8.0, 16.0, 4.0, 32.0};
constexpr double kExploreGate = 4;
constexpr double kCoarseFinalGate = 2, kFineFinalGate = 1.5;
constexpr int kMaxExplorations = 3;
constexpr std::size_t kMinSamplePoints = 30;

struct Candidate {
  RegistrationResult fit;
  AlignmentEvidence evidence;
  Verdict verdict;
  bool found = false;
};

bool better(const Candidate& a, const Candidate& b) {
  if (a.verdict.accepted != b.verdict.accepted) return a.verdict.accepted;
  return a.evidence.consensus() > b.evidence.consensus();
}

class Placer {
 public:
  Placer(const PreparedScan& scan, const ScanPyramid& merged, const PipelineOptions& options)
      : scan_(scan), merged_(merged), options_(options), voxel_m_(merged.level(0).voxel_size_m) {}

  const LpFigures& figures() const { return figures_; }

  AlignmentEvidence verify(const Eigen::Isometry3d& T) const {
    return verify_alignment(scan_.held_out_sample, merged_.level(0), T, verification_at(voxel_m_));
  }

  /// The best of the gate ladder from T_init.
  Candidate fit_from(const Eigen::Isometry3d& T_init) {
    Candidate best;
    for (const double gate : kGateLadder) {
      const Candidate candidate = fit_and_verify(T_init, gate);
      if (!best.found || (candidate.found && better(candidate, best))) best = candidate;
      if (best.verdict.accepted) break;
    }
    return best;
  }

  /// Fits from the best shifts of the initial guess, too.
  void try_shifts(const Eigen::Isometry3d& T_init, Candidate& best) {
    for (const auto& T : other_minima(scan_.coarse_sample, scan_.held_out_sample, merged_, T_init)) {
      const Candidate candidate = fit_and_verify(T, kGateLadder[0]);
      if (candidate.found && (!best.found || better(candidate, best))) best = candidate;
    }
  }

  /// Looks for other poses that fit as well; the one with the largest consensus wins. Repeated structure (bays of a
  /// hall, rows of trees) shows here and nowhere else: each of its fits looks right by itself.
  void explore(Candidate& best) {
    double runner_up = 0;
    bool changed = true;
    for (int round = 0; changed && round < kMaxExplorations; ++round) {
      changed = false;
      const Eigen::Isometry3d T_round = best.fit.T_target_source;
      for (const auto& T : other_minima(scan_.coarse_sample, scan_.held_out_sample, merged_, T_round)) {
        const Candidate other = fit_and_verify(T, kExploreGate);
        if (!other.found || same_pose(other, best)) continue;
        const double mine = best.evidence.consensus(), others = other.evidence.consensus();
        if (others > mine) {
          runner_up = mine / others;
          best = other;
          changed = true;
        } else if (mine > 0) {
          runner_up = std::max(runner_up, others / mine);
        }
      }
    }
    best.evidence.runner_up = runner_up;
  }

  void refine(Candidate& candidate, Rng& rng, MergeRecord& record) const {
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

 private:
  Candidate fit_and_verify(const Eigen::Isometry3d& T_init, double gate_in_voxels) {
    Candidate candidate;
    candidate.fit = fit(T_init, gate_in_voxels * voxel_m_);
    candidate.found = candidate.fit.usable();
    if (!candidate.found) return candidate;
    candidate.evidence = verify(candidate.fit.T_target_source);
    candidate.verdict = judge(candidate.evidence);
    return candidate;
  }

  /// Coarse programs over every kind of point, then finer ones over surfaces.
  RegistrationResult fit(const Eigen::Isometry3d& T_init, double gate_m) {
    LpRegistrationOptions lp;
    lp.lp = options_.lp;
    lp.initial_gate_m = gate_m;
    lp.final_gate_m = kCoarseFinalGate * voxel_m_;
    RegistrationResult coarse = register_lp(scan_.coarse_sample, merged_, T_init, lp);
    figures_ += coarse.lp;
    if (!coarse.usable()) return coarse;
    lp.initial_gate_m = kCoarseFinalGate * voxel_m_;
    lp.final_gate_m = kFineFinalGate * voxel_m_;
    lp.initial_normal_angle_deg = lp.final_normal_angle_deg;
    RegistrationResult fine = register_lp(scan_.fit_sample, merged_, coarse.T_target_source, lp);
    figures_ += fine.lp;
    fine.num_iterations += coarse.num_iterations;
    return fine;
  }

  bool same_pose(const Candidate& a, const Candidate& b) const {
    const Eigen::Isometry3d apart = a.fit.T_target_source.inverse() * b.fit.T_target_source;
    return rms_displacement(apart, scan_.held_out_sample.points) < kSearchGridStep / 2 * voxel_m_;
  }

  const PreparedScan& scan_;
  const ScanPyramid& merged_;
  const PipelineOptions& options_;
  double voxel_m_;
  LpFigures figures_;  // of all programs so far
};

}  // namespace

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

Eigen::Isometry3d place_scan(const PreparedScan& scan, const ScanPyramid& merged, const Eigen::Isometry3d& T_init,
                             const PipelineOptions& options, Rng& rng, MergeRecord& record) {
  if (std::min(scan.coarse_sample.size(), scan.held_out_sample.size()) < kMinSamplePoints) {
    record.simplex.termination = Termination::kTooFewCorrespondences;
    record.reason = "too few of its points lie on surfaces";
    return T_init;
  }
  Placer placer(scan, merged, options);
  Candidate best = placer.fit_from(T_init);
  if (!best.verdict.accepted && options.placement.search_steps > 0) {
    record.searched = true;
    placer.try_shifts(T_init, best);
  }
  if (!best.verdict.accepted && options.placement.search_steps > 0) {
    const Eigen::Isometry3d T =
        search_by_annealing(scan.coarse_sample, scan.held_out_sample, merged, T_init, options, rng);
    const Candidate found = placer.fit_from(T);
    if (found.found && (!best.found || better(found, best))) best = found;
  }
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
  const Verdict verdict = judge(*record.evidence);
  record.accepted = verdict.accepted;
  record.reason = verdict.reason;
  return best.fit.T_target_source;
}

}  // namespace tcm_icp
