#include "merging/fit_to_cloud.hpp"

#include <algorithm>

#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/registration/alignment_objective.hpp"
#include "tcm_icp/registration/lp_registration.hpp"

namespace tcm_icp {
namespace {

// Maximum correspondence distances, in coarse voxels.
constexpr double kFirstDistance = 4, kMiddleDistance = 2, kLastDistance = 1.5;
constexpr int kMaxLpSolves = 20;  // most fits settle within 15
constexpr std::size_t kMinPoints = 30;

LpRegistrationOptions lp_options(const MergeOptions& options, double first_m, double last_m) {
  LpRegistrationOptions lp;
  lp.formulation = options.formulation;
  lp.lp = options.lp;
  lp.initial_gate_m = first_m;
  lp.final_gate_m = last_m;
  lp.max_iterations = kMaxLpSolves;
  return lp;
}

RegistrationResult solve(const PreparedScan& scan, const ScanPyramid& s, const Eigen::Isometry3d& T_init,
                         const MergeOptions& options) {
  const double voxel_m = s.level(0).voxel_size_m;
  const RegistrationResult coarse = register_lp(
      scan.coarse_sample, s, T_init, lp_options(options, kFirstDistance * voxel_m, kMiddleDistance * voxel_m));
  if (!coarse.usable()) return coarse;
  LpRegistrationOptions lp = lp_options(options, kMiddleDistance * voxel_m, kLastDistance * voxel_m);
  lp.initial_normal_angle_deg = lp.final_normal_angle_deg;
  RegistrationResult fine = register_lp(scan.fit_sample, s, coarse.T_target_source, lp);
  fine.num_iterations += coarse.num_iterations;
  fine.lp += coarse.lp;
  return fine;
}

void refine(const PreparedScan& scan, const ScanPyramid& s, const RefinementOptions& o, Rng& rng, MergeRecord& record,
            Eigen::Isometry3d& T) {
  if (o.method == Refinement::kNone) return;
  const auto count = static_cast<std::size_t>(o.points);
  const double voxel_m = s.level(0).voxel_size_m;
  const Cloud fit = even_sample(scan.fit_sample, count), kept = even_sample(scan.held_out_sample, count);
  // The fit's own residual is the noise; a voxel's hundredth keeps perfect data from a scale of zero.
  const double noise_m = std::max(record.simplex.median_residual_m, voxel_m / 100);
  const AlignmentObjective objective(fit, s.level(0), 2 * noise_m, 2 * voxel_m);
  const AlignmentObjective held_out_objective(kept, s.level(0), 2 * noise_m, 2 * voxel_m);
  const PoseCost cost = [&](const Eigen::Isometry3d& pose) { return objective.cost(pose); };
  const PoseCost held_out = [&](const Eigen::Isometry3d& pose) { return held_out_objective.cost(pose); };
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

Eigen::Isometry3d fit_to_cloud(const PreparedScan& scan, const ScanPyramid& s, const Eigen::Isometry3d& T_init,
                               const MergeOptions& options, Rng& rng, MergeRecord& record) {
  if (std::min(scan.coarse_sample.size(), scan.fit_sample.size()) < kMinPoints) {
    record.simplex.termination = Termination::kTooFewCorrespondences;
    return T_init;
  }
  record.simplex = solve(scan, s, T_init, options);
  if (!record.simplex.usable()) return T_init;
  Eigen::Isometry3d T = record.simplex.T_target_source;
  refine(scan, s, options.refinement, rng, record, T);
  return T;
}

}  // namespace tcm_icp
