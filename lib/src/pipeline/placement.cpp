#include "placement.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/alignment_objective.hpp"
#include "tcm_icp/registration/lp_registration.hpp"
#include "verdict.hpp"

namespace tcm_icp {
namespace {

// First gates of the linear programs, in coarse voxels, in the order they are tried.
constexpr std::array kGateLadder{8.0, 16.0, 4.0, 32.0};
constexpr double kCoarseFinalGate = 2.0, kFineFinalGate = 1.5;
constexpr int kSearchPoints = 300;

// Looking for other poses: a grid of 13 x 13 steps of 4 coarse voxels, whose best minima are fitted.
constexpr int kExploreReach = 6, kExplorePoints = 200, kMaxExplorations = 3;
constexpr double kExploreStep = 4, kExploreGate = 4;
constexpr std::size_t kMaxOtherMinima = 3;

Cloud thinned(const Cloud& cloud, int count, std::size_t offset) {
  Cloud out;
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / static_cast<std::size_t>(count));
  for (std::size_t i = std::min(offset, step - 1); i < cloud.size(); i += step) {
    out.points.push_back(cloud.points[i]);
    out.normals.push_back(cloud.normals[i]);
  }
  return out;
}

TwistFrame frame_of(const Cloud& cloud, const Eigen::Isometry3d& T) {
  TwistFrame frame;
  for (const auto& p : cloud.points) frame.centre += T * p;
  frame.centre /= static_cast<double>(cloud.size());
  double squared = 0;
  for (const auto& p : cloud.points) squared += (T * p - frame.centre).squaredNorm();
  frame.radius_m = std::max(std::sqrt(squared / static_cast<double>(cloud.size())), 1e-12);
  return frame;
}

class Placer {
 public:
  Placer(const PreparedScan& scan, const ScanPyramid& merged, const PipelineOptions& options)
      : scan_(scan), merged_(merged), options_(options), voxel_m_(merged.level(0).voxel_size_m) {}

  struct Candidate {
    RegistrationResult fit;
    AlignmentEvidence evidence;
    Verdict verdict;
    bool found = false;
  };

  AlignmentEvidence verify(const Eigen::Isometry3d& T) const {
    return verify_alignment(scan_.held_out_sample, merged_.level(0), T, verification_at(voxel_m_));
  }

  /// The best of the gate ladder from T_init; `figures` adds up the effort of all.
  Candidate fit_from(const Eigen::Isometry3d& T_init, LpFigures& figures) const {
    Candidate best;
    for (const double gate : kGateLadder) {
      Candidate candidate;
      candidate.fit = fit_at(T_init, gate * voxel_m_, figures);
      if (!candidate.fit.usable()) {
        if (!best.found) best.fit = candidate.fit;
        continue;
      }
      candidate.found = true;
      candidate.evidence = verify(candidate.fit.T_target_source);
      candidate.verdict = judge(candidate.evidence);
      if (!best.found || better(candidate, best)) best = candidate;
      if (best.verdict.accepted) break;
    }
    return best;
  }

  static bool better(const Candidate& a, const Candidate& b) {
    if (a.verdict.accepted != b.verdict.accepted) return a.verdict.accepted;
    return a.evidence.consensus() > b.evidence.consensus();
  }

  /// Annealing from the initial guess over a wide range: where to start the programs again.
  Eigen::Isometry3d search(const Eigen::Isometry3d& T_init, Rng& rng) const {
    const Cloud walked = thinned(scan_.coarse_sample, kSearchPoints, 0);
    const Cloud kept = thinned(scan_.held_out_sample, kSearchPoints, 0);
    const PyramidLevel& level = merged_.level_for(2 * voxel_m_);
    const AlignmentObjective cost(walked, level, voxel_m_, 4 * voxel_m_);
    const AlignmentObjective held_out(kept, level, voxel_m_, 4 * voxel_m_);
    AnnealingOptions annealing;
    annealing.initial_step_m = kGateLadder[0] * voxel_m_;
    annealing.final_step_m = voxel_m_ / 2;
    annealing.num_steps = options_.placement.search_steps;
    annealing.initial_temperature = options_.refinement.initial_temperature;
    annealing.final_temperature = options_.refinement.final_temperature;
    return anneal([&](const Eigen::Isometry3d& T) { return cost.cost(T); },
                  [&](const Eigen::Isometry3d& T) { return held_out.cost(T); }, frame_of(walked, T_init), T_init,
                  annealing, rng)
        .T_target_source;
  }

  /// Looks for other poses that fit: the cost is scanned over a grid in the plane of the two weakest translations, the
  /// scan is fitted again from its best minima, and the pose with the largest consensus wins. Repeated structure (bays
  /// of a hall, rows of trees) shows here and nowhere else: each of its fits looks right by itself.
  void explore(Candidate& best, LpFigures& figures) const {
    double runner_up = 0;
    for (int round = 0; round < kMaxExplorations; ++round) {
      const Eigen::Isometry3d T_round = best.fit.T_target_source;
      for (const Eigen::Isometry3d& T : other_minima(T_round)) {
        Candidate other;
        other.fit = fit_at(T, kExploreGate * voxel_m_, figures);
        if (!other.fit.usable()) continue;
        const Eigen::Isometry3d apart = best.fit.T_target_source.inverse() * other.fit.T_target_source;
        if (rms_displacement(apart, scan_.held_out_sample.points) < kExploreStep * voxel_m_ / 2) continue;
        other.found = true;
        other.evidence = verify(other.fit.T_target_source);
        other.verdict = judge(other.evidence);
        const double mine = best.evidence.consensus(), others = other.evidence.consensus();
        if (others > mine) {
          runner_up = mine / others;
          best = other;
        } else if (mine > 0) {
          runner_up = std::max(runner_up, others / mine);
        }
      }
      if (best.fit.T_target_source.isApprox(T_round, 0)) break;
    }
    best.evidence.runner_up = runner_up;
    best.verdict = judge(best.evidence);
  }

  void refine(Candidate& candidate, Rng& rng, MergeRecord& record) const {
    const RefinementOptions& o = options_.refinement;
    const bool descent = o.method == Refinement::kDescent || o.method == Refinement::kDescentThenAnnealing;
    const bool annealing = o.method == Refinement::kAnnealing || o.method == Refinement::kDescentThenAnnealing;
    const Cloud fit = thinned(scan_.fit_sample, o.points, 0), kept = thinned(scan_.held_out_sample, o.points, 0);
    // The fit's own residual is the noise; a voxel's hundredth keeps perfect data from a scale of zero.
    const double noise_m = std::max(candidate.fit.median_residual_m, voxel_m_ / 100);
    const AlignmentObjective objective(fit, merged_.level(0), 2 * noise_m, 2 * voxel_m_);
    const AlignmentObjective held_out_objective(kept, merged_.level(0), 2 * noise_m, 2 * voxel_m_);
    const PoseCost cost = [&](const Eigen::Isometry3d& T) { return objective.cost(T); };
    const PoseCost held_out = [&](const Eigen::Isometry3d& T) { return held_out_objective.cost(T); };
    Eigen::Isometry3d& T = candidate.fit.T_target_source;
    const TwistFrame frame = frame_of(fit, T);
    if (descent) {
      const PoseGradient gradient = [&](const Eigen::Isometry3d& pose, Twist& slope) {
        return objective.cost_and_gradient(pose, frame.centre, slope);
      };
      DescentOptions d;
      d.initial_step_m = noise_m / 2;
      d.min_step_m = noise_m / 64;
      d.max_steps = o.descent_steps;
      record.descent = descend(cost, gradient, held_out, frame, T, d);
      T = record.descent->T_target_source;
    }
    if (annealing) {
      AnnealingOptions a;
      a.initial_step_m = noise_m / 2;
      a.final_step_m = noise_m / 32;
      a.num_steps = o.annealing_steps;
      a.initial_temperature = o.initial_temperature;
      a.final_temperature = o.final_temperature;
      record.annealing = anneal(cost, held_out, frame, T, a, rng);
      T = record.annealing->T_target_source;
    }
  }

 private:
  // The two directions the scan can be shifted along most freely: eigenvectors of the sum of n n' over its surfaces.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> weakest_translations(const Eigen::Isometry3d& T) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const auto& n : scan_.held_out_sample.normals) {
      const Eigen::Vector3d moved = T.linear() * n;
      sum += moved * moved.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(sum);
    return {axes.eigenvectors().col(0), axes.eigenvectors().col(1)};
  }

  std::vector<Eigen::Isometry3d> other_minima(const Eigen::Isometry3d& T) const {
    const Cloud points = thinned(scan_.coarse_sample, kExplorePoints, 0);
    const AlignmentObjective objective(points, merged_.level_for(2 * voxel_m_), voxel_m_, kExploreStep * voxel_m_);
    const auto [u, v] = weakest_translations(T);
    const auto at = [&](int i, int j) {
      return Eigen::Isometry3d(Eigen::Translation3d(kExploreStep * voxel_m_ * (i * u + j * v)) * T);
    };
    constexpr int kSide = 2 * kExploreReach + 1;
    std::array<double, static_cast<std::size_t>(kSide * kSide)> cost{};
    const auto slot = [](int i, int j) {
      return static_cast<std::size_t>((i + kExploreReach) * kSide + (j + kExploreReach));
    };
    for (int i = -kExploreReach; i <= kExploreReach; ++i) {
      for (int j = -kExploreReach; j <= kExploreReach; ++j) cost[slot(i, j)] = objective.cost(at(i, j));
    }
    std::vector<std::pair<double, Eigen::Isometry3d>> minima;
    for (int i = -kExploreReach; i <= kExploreReach; ++i) {
      for (int j = -kExploreReach; j <= kExploreReach; ++j) {
        if (std::abs(i) <= 1 && std::abs(j) <= 1) continue;  // the pose itself
        bool lowest = true;
        for (int di = -1; di <= 1; ++di) {
          for (int dj = -1; dj <= 1; ++dj) {
            const bool inside = std::abs(i + di) <= kExploreReach && std::abs(j + dj) <= kExploreReach;
            lowest = lowest && (!inside || cost[slot(i, j)] <= cost[slot(i + di, j + dj)]);
          }
        }
        if (lowest) minima.emplace_back(cost[slot(i, j)], at(i, j));
      }
    }
    std::stable_sort(minima.begin(), minima.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Eigen::Isometry3d> out;
    for (std::size_t k = 0; k < std::min(minima.size(), kMaxOtherMinima); ++k) out.push_back(minima[k].second);
    return out;
  }

  RegistrationResult fit_at(const Eigen::Isometry3d& T_init, double gate_m, LpFigures& figures) const {
    LpRegistrationOptions lp;
    lp.lp = options_.lp;
    lp.initial_gate_m = gate_m;
    lp.final_gate_m = kCoarseFinalGate * voxel_m_;
    RegistrationResult coarse = register_lp(scan_.coarse_sample, merged_, T_init, lp);
    add(figures, coarse.lp);
    if (!coarse.usable()) return coarse;
    lp.initial_gate_m = kCoarseFinalGate * voxel_m_;
    lp.final_gate_m = kFineFinalGate * voxel_m_;
    lp.initial_normal_angle_deg = lp.final_normal_angle_deg;
    RegistrationResult fine = register_lp(scan_.fit_sample, merged_, coarse.T_target_source, lp);
    add(figures, fine.lp);
    fine.num_iterations += coarse.num_iterations;
    return fine;
  }

  static void add(LpFigures& sum, const LpFigures& part) {
    sum.num_programs += part.num_programs;
    sum.num_pivots += part.num_pivots;
    sum.seconds += part.seconds;
    sum.objective = part.objective;
    sum.relative_duality_gap = std::fmax(sum.relative_duality_gap, part.relative_duality_gap);
  }

  const PreparedScan& scan_;
  const ScanPyramid& merged_;
  const PipelineOptions& options_;
  double voxel_m_;
};

}  // namespace

Eigen::Isometry3d place_scan(const PreparedScan& scan, const ScanPyramid& merged, const Eigen::Isometry3d& T_init,
                             const PipelineOptions& options, Rng& rng, MergeRecord& record) {
  const Placer placer(scan, merged, options);
  LpFigures figures;
  Placer::Candidate best = placer.fit_from(T_init, figures);
  if (!best.verdict.accepted && options.placement.search_steps > 0) {
    record.searched = true;
    const Placer::Candidate found = placer.fit_from(placer.search(T_init, rng), figures);
    if (found.found && (!best.found || Placer::better(found, best))) best = found;
  }
  record.simplex = best.fit;
  record.simplex.lp = figures;
  if (!best.found) {
    record.reason = "the simplex step found no pose: " + std::string(to_string(best.fit.termination));
    return T_init;
  }
  placer.explore(best, figures);
  record.simplex = best.fit;
  record.simplex.lp = figures;
  placer.refine(best, rng, record);
  const double runner_up = best.evidence.runner_up;
  record.evidence = placer.verify(best.fit.T_target_source);
  record.evidence->runner_up = runner_up;
  const Verdict verdict = judge(*record.evidence);
  record.accepted = verdict.accepted;
  record.reason = verdict.reason;
  return best.fit.T_target_source;
}

}  // namespace tcm_icp
