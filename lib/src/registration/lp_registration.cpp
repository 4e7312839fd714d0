#include "tcm_icp/registration/lp_registration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

double median_plane_distance(const Correspondences& matches) {
  std::vector<double> values;
  values.reserve(matches.size());
  for (const auto& m : matches) values.push_back(std::abs(m.normal.dot(m.source - m.target)));
  return median(values);
}

}  // namespace

std::string_view to_string(Termination termination) {
  switch (termination) {
    case Termination::kNotRun:
      return "not run";
    case Termination::kConverged:
      return "converged";
    case Termination::kMaxIterations:
      return "max iterations";
    case Termination::kStopped:
      return "stopped";
    case Termination::kTooFewCorrespondences:
      return "too few correspondences";
    case Termination::kLpInfeasible:
      return "LP infeasible";
    case Termination::kLpFailed:
      return "LP failed";
  }
  return "unknown";
}

LpFigures& LpFigures::operator+=(const LpFigures& later) {
  num_programs += later.num_programs;
  num_pivots += later.num_pivots;
  if (later.num_programs > 0) objective = later.objective;
  relative_duality_gap = std::fmax(relative_duality_gap, later.relative_duality_gap);  // NaN is "none yet"
  seconds += later.seconds;
  return *this;
}

void LpRegistrationOptions::validate() const {
  const auto require = [](bool ok, const char* what, double value) {
    if (!ok) throw InvalidOptions(std::string(what) + ", not " + std::to_string(value));
  };
  require(initial_gate_m > 0, "initial_gate_m must be above 0 m", initial_gate_m);
  require(final_gate_m > 0 && final_gate_m <= initial_gate_m,
          "final_gate_m must be above 0 m and at most initial_gate_m", final_gate_m);
  require(gate_shrink > 0 && gate_shrink < 1, "gate_shrink must be between 0 and 1", gate_shrink);
  require(initial_normal_angle_deg > 0 && initial_normal_angle_deg <= 90,
          "initial_normal_angle_deg must be above 0 and at most 90 degrees", initial_normal_angle_deg);
  require(final_normal_angle_deg > 0 && final_normal_angle_deg <= 90,
          "final_normal_angle_deg must be above 0 and at most 90 degrees", final_normal_angle_deg);
  require(max_iterations >= 1, "max_iterations must be at least 1", max_iterations);
  require(convergence_share > 0, "convergence_share must be above 0", convergence_share);
  require(min_correspondences >= 6, "min_correspondences must be at least 6", min_correspondences);
  lp.validate();
}

RegistrationResult register_lp(const Cloud& source, const ScanPyramid& target, const Eigen::Isometry3d& T_init,
                               const LpRegistrationOptions& options, const MatchSelection& select) {
  options.validate();
  if (!source.empty() && !source.has_normals()) throw InvalidInput("register_lp needs a source with normals");
  RegistrationResult result;
  result.T_target_source = T_init;
  result.termination = Termination::kMaxIterations;
  double gate = options.initial_gate_m;
  const double still_m = options.convergence_share * options.final_gate_m;
  const PointMoments moments(source.points);
  std::vector<Eigen::Isometry3d> reached;  // by steps at the final gate
  // The angle closes with the gate: 1 at the initial gate, 0 at the final one, on a logarithmic scale.
  const double log_range = std::log(options.initial_gate_m / options.final_gate_m);
  for (int i = 0; i < options.max_iterations; ++i) {
    const bool final_gate = gate <= options.final_gate_m;
    const double openness = log_range > 0 ? std::log(gate / options.final_gate_m) / log_range : 0;
    const double angle =
        options.final_normal_angle_deg + openness * (options.initial_normal_angle_deg - options.final_normal_angle_deg);
    auto matches =
        find_correspondences(source, result.T_target_source, target.level_for(gate / 3), {gate, radians(angle)});
    if (select) select(result.T_target_source, matches);
    result.num_correspondences = matches.size();
    if (static_cast<int>(matches.size()) < options.min_correspondences) {
      result.termination = Termination::kTooFewCorrespondences;
      return result;
    }
    result.median_residual_m = median_plane_distance(matches);
    double step_m = 0;
    const Termination step =
        registration_step(options.formulation, matches, options.lp, result.T_target_source, result.lp, step_m);
    if (step != Termination::kConverged) {
      result.termination = step;
      return result;
    }
    ++result.num_iterations;
    // A few matches that change and change back lead round in a circle.
    const auto is_where = [&](const Eigen::Isometry3d& T) {
      return rms_displacement(T.inverse() * result.T_target_source, moments) < still_m;
    };
    if (final_gate && (step_m < still_m || std::any_of(reached.begin(), reached.end(), is_where))) {
      result.termination = Termination::kConverged;
      return result;
    }
    if (final_gate) reached.push_back(result.T_target_source);
    gate = std::max(options.final_gate_m, gate * options.gate_shrink);
  }
  return result;
}

}  // namespace tcm_icp
