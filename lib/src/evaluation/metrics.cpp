#include "tcm_icp/evaluation/metrics.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Estimates = std::vector<std::optional<Isometry3d>>;

ScanScore score_scan(const Truth& truth, const Estimates& estimates, std::size_t reference, std::size_t i,
                     const Points& points) {
  const TrueScan& scan = truth.scans[i];
  ScanScore score{scan.file, std::nullopt, PoseVerdict::kFlagged};
  if (scan.group != truth.scans[reference].group) {
    score.verdict = estimates[i] ? PoseVerdict::kWrong : PoseVerdict::kOk;
  } else if (estimates[i]) {
    score.error = pose_error(truth.scans[reference].T_world_scan, scan.T_world_scan, *estimates[reference],
                             *estimates[i], points);
    score.verdict = score.error->within(truth.tolerance) ? PoseVerdict::kOk : PoseVerdict::kWrong;
  }
  return score;
}

double true_overlap(const Truth& truth, std::size_t i, std::size_t j) {
  if (truth.overlap.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
  return std::max(truth.overlap(a, b), truth.overlap(b, a));
}

void count_pairs(const Truth& truth, const Estimates& estimates, const std::vector<Points>& points,
                 const ScoreOptions& options, SceneScore& score) {
  for (std::size_t i = 0; i < truth.scans.size(); ++i) {
    for (std::size_t j = i + 1; j < truth.scans.size(); ++j) {
      if (truth.scans[i].group != truth.scans[score.reference].group) continue;
      if (!truth.pair_counts(i, j, options.min_overlap)) continue;
      PairScore pair{i, j, true_overlap(truth, i, j), std::nullopt, false};
      if (estimates[i] && estimates[j]) {
        pair.error = pose_error(truth.scans[i].T_world_scan, truth.scans[j].T_world_scan, *estimates[i], *estimates[j],
                                points[j]);
        pair.is_ok = pair.error->within(truth.tolerance);
      }
      score.pairs.push_back(pair);
      score.num_pairs_ok += pair.is_ok ? 1 : 0;
    }
  }
  score.num_pairs = score.pairs.size();
}

/// Mean of the two middle values where their number is even.
double exact_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

void summarise(SceneScore& score) {
  std::vector<double> rotations_deg, rmses_m, translations_m;
  for (std::size_t i = 0; i < score.scans.size(); ++i) {
    if (i == score.reference || !score.scans[i].error) continue;
    rotations_deg.push_back(score.scans[i].error->rotation_deg);
    rmses_m.push_back(score.scans[i].error->rmse_m);
    translations_m.push_back(score.scans[i].error->translation_m);
  }
  if (rmses_m.empty()) return;
  score.median = PoseError{exact_median(rotations_deg), exact_median(rmses_m), exact_median(translations_m)};
  score.max_rmse_m = *std::max_element(rmses_m.begin(), rmses_m.end());
}

}  // namespace

PoseError pose_error(const Isometry3d& T_true_ref, const Isometry3d& T_true_i, const Isometry3d& T_est_ref,
                     const Isometry3d& T_est_i, const Points& points) {
  // Full inverses: a pose from a file is rigid to its printed digits only, and E should be what the file says.
  const auto relative = [](const Isometry3d& a, const Isometry3d& b) -> Isometry3d {
    return a.inverse(Eigen::Affine) * b;
  };
  const Isometry3d E = relative(relative(T_true_ref, T_true_i), relative(T_est_ref, T_est_i));
  return {rotation_angle_rad(E.linear()) * 180 / std::numbers::pi, rms_displacement(E, points), E.translation().norm()};
}

std::string to_string(PoseVerdict verdict) {
  switch (verdict) {
    case PoseVerdict::kOk:
      return "ok";
    case PoseVerdict::kFlagged:
      return "flagged";
    case PoseVerdict::kWrong:
      return "WRONG";
  }
  throw InvalidInput("unknown verdict");
}

std::size_t SceneScore::count(PoseVerdict verdict) const {
  return static_cast<std::size_t>(
      std::count_if(scans.begin(), scans.end(), [&](const ScanScore& s) { return s.verdict == verdict; }));
}

double SceneScore::recall() const { return static_cast<double>(num_pairs_ok) / static_cast<double>(num_pairs); }

void ScoreOptions::validate() const {
  if (!(min_overlap >= 0 && min_overlap <= 1)) {
    throw InvalidOptions("min_overlap = " + std::to_string(min_overlap) + "; needs 0..1");
  }
}

SceneScore score_poses(const Truth& truth, const Estimates& estimates, std::size_t reference,
                       const std::vector<Points>& points, const ScoreOptions& options) {
  options.validate();
  const std::size_t n = truth.scans.size();
  if (estimates.size() != n || points.size() != n) {
    throw InvalidInput("score: " + std::to_string(n) + " scans in the truth, " + std::to_string(estimates.size()) +
                       " estimates, " + std::to_string(points.size()) + " point sets");
  }
  if (reference >= n || !estimates[reference]) throw InvalidInput("score: the reference scan has no pose");
  SceneScore score;
  score.reference = reference;
  for (std::size_t i = 0; i < n; ++i) score.scans.push_back(score_scan(truth, estimates, reference, i, points[i]));
  count_pairs(truth, estimates, points, options, score);
  summarise(score);
  return score;
}

}  // namespace tcm_icp
