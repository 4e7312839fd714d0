#include "tcm_icp/registration/paper_registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "determined_directions.hpp"
#include "lp_figures.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/registration/lp_registration.hpp"

namespace tcm_icp {
namespace {

Eigen::Vector3d centroid(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

double rms_distance(const Points& points, const Eigen::Vector3d& centre) {
  double squared = 0;
  for (const auto& p : points) squared += (p - centre).squaredNorm();
  return std::sqrt(squared / static_cast<double>(points.size()));
}

// What T adds to the rotated points, of all that they leave it: the L1 optimum, or the one farthest to a side.
double shift_of(std::vector<double> rest, PaperSlack slack) {
  if (slack == PaperSlack::kBoth) return median(rest);
  const auto [least, most] = std::minmax_element(rest.begin(), rest.end());
  if (slack == PaperSlack::kAbove) return *most;
  return slack == PaperSlack::kBelow ? *least : (*least + *most) / 2;
}

// One row of (R, T) in the columns of A, by one program; by two where they are averaged.
Termination fit_row(const Eigen::MatrixXd& A, const Eigen::VectorXd& d, const L1FitOptions& options, PaperSlack slack,
                    Eigen::VectorXd& x, LpFigures& figures, double& objective) {
  L1FitOptions sided = options;
  if (slack == PaperSlack::kAbove || slack == PaperSlack::kBetween) sided.side = L1Side::kAbove;
  if (slack == PaperSlack::kBelow) sided.side = L1Side::kBelow;
  const L1FitResult fit = fit_l1(A, d, sided);
  figures += figures_of(fit);
  if (!fit.optimal()) return termination_of(fit.status);
  x = fit.x;
  objective += fit.objective;
  if (slack != PaperSlack::kBetween) return Termination::kConverged;
  const Termination below = fit_row(A, d, options, PaperSlack::kBelow, x, figures, objective);
  x = (x + fit.x) / 2;
  return below;
}

}  // namespace

void PaperRegistrationOptions::validate() const {
  reading.validate();
  if (!(threshold_m >= 0)) {
    throw InvalidOptions("threshold_m must be at least 0, not " + std::to_string(threshold_m));
  }
  if (!(convergence_share > 0)) {
    throw InvalidOptions("convergence_share must be above 0, not " + std::to_string(convergence_share));
  }
  lp.validate();
}

Termination paper_simplex_step(const Points& source, const Points& target, const L1FitOptions& options,
                               Eigen::Isometry3d& T_target_source, LpFigures& figures, PaperSlack slack) {
  if (source.size() != target.size()) {
    throw InvalidInput("paper_simplex_step: " + std::to_string(source.size()) + " source points, but " +
                       std::to_string(target.size()) + " target points");
  }
  if (source.size() < 4) return Termination::kTooFewCorrespondences;
  const auto n = static_cast<Eigen::Index>(source.size());
  const Eigen::Vector3d centre = centroid(source);  // about the centroid R and T hardly depend on each other
  const double radius = std::max(rms_distance(source, centre), std::numeric_limits<double>::min());
  Eigen::MatrixXd A(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    A.row(i) << (source[static_cast<std::size_t>(i)] - centre).transpose() / radius, 1;
  }
  // A flat scan says nothing of one column of R: it stays 0 for the projection to fill, instead of blown-up rounding.
  const Eigen::MatrixXd basis = determined_directions(A, options.rank_tolerance);
  Eigen::Matrix3d linear;
  Eigen::VectorXd d(n);
  double objective = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (Eigen::Index i = 0; i < n; ++i) d[i] = target[static_cast<std::size_t>(i)][axis];
    Eigen::VectorXd x;
    const Termination fitted = fit_row(A * basis, d, options, slack, x, figures, objective);
    if (fitted != Termination::kConverged) return fitted;
    linear.row(axis) = (basis * x).head<3>().transpose() / radius;
  }
  figures.objective = objective;
  T_target_source.linear() = project_onto_so3(linear);  // the program leaves R linear, not orthonormal
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> rest(source.size());
    for (std::size_t i = 0; i < source.size(); ++i) {
      rest[i] = target[i][axis] - T_target_source.linear().row(axis).dot(source[i]);
    }
    T_target_source.translation()[axis] = shift_of(rest, slack);  // T's optimum for this R
  }
  return Termination::kConverged;
}

namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A program in 6 unknowns for the matches, moved to where they were matched.
Termination twist_step(const PaperMatchedPoints& matches, const L1FitOptions& options,
                       Eigen::Isometry3d& T_target_source, LpFigures& figures) {
  Correspondences moved;
  for (std::size_t i = 0; i < matches.source.size(); ++i) {
    moved.push_back({T_target_source * matches.source[i], matches.target[i], Eigen::Vector3d::Zero(), 1});
  }
  double step_m = 0;
  return registration_step(LpFormulation::kPointToPoint, moved, options, T_target_source, figures, step_m);
}

}  // namespace

RegistrationResult register_paper(const Points& source, const Points& target, const NeighborIndex& target_index,
                                  const Eigen::Isometry3d& T_init, const PaperRegistrationOptions& options) {
  options.validate();
  const PaperOptions& reading = options.reading;
  RegistrationResult result;
  result.T_target_source = T_init;
  result.termination = Termination::kMaxIterations;
  if (source.size() < 4 || target.empty()) {
    result.termination = Termination::kTooFewCorrespondences;
    return result;
  }
  const double radius = rms_distance(source, centroid(source));
  const NeighborIndex source_index(reading.matches == PaperMatches::kMutual ? source : Points{});
  double least_slack = std::numeric_limits<double>::infinity();
  Eigen::Isometry3d best = T_init;
  for (int i = 0; i < reading.max_rounds; ++i) {
    PaperMatchedPoints matches =
        paper_matches(source, source_index, target, target_index, result.T_target_source, options);
    if (matches.source.size() < 4) {
      result.termination = Termination::kTooFewCorrespondences;
      return result;
    }
    if (reading.end == PaperEnd::kSlack) {
      const double slack = mean(matches.distances);
      const bool falls = slack < (1 - options.convergence_share) * least_slack;
      if (slack < least_slack) best = result.T_target_source;
      least_slack = std::min(slack, least_slack);
      if (!falls) {
        result.T_target_source = best;
        result.termination = Termination::kConverged;
        return result;
      }
    }
    result.num_correspondences = matches.source.size();
    result.median_residual_m = median(matches.distances);
    Eigen::Isometry3d next = result.T_target_source;
    const Termination step =
        reading.unknowns == PaperUnknowns::kTwist
            ? twist_step(matches, options.lp, next, result.lp)
            : paper_simplex_step(matches.source, matches.target, options.lp, next, result.lp, reading.slack);
    if (step != Termination::kConverged) {
      result.termination = step;
      return result;
    }
    double moved = 0;
    for (const auto& p : source) moved += (next * p - result.T_target_source * p).squaredNorm();
    moved = std::sqrt(moved / static_cast<double>(source.size()));
    result.T_target_source = next;
    ++result.num_iterations;
    if (reading.end == PaperEnd::kMotion && moved <= options.convergence_share * radius) {
      result.termination = Termination::kConverged;
      return result;
    }
  }
  return result;
}

}  // namespace tcm_icp
