#include "tcm_icp/registration/paper_registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "determined_directions.hpp"
#include "lp_figures.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/statistics.hpp"

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

}  // namespace

void PaperRegistrationOptions::validate() const {
  if (max_iterations < 1) {
    throw InvalidOptions("max_iterations must be at least 1, not " + std::to_string(max_iterations));
  }
  if (!(convergence_share > 0)) {
    throw InvalidOptions("convergence_share must be above 0, not " + std::to_string(convergence_share));
  }
  lp.validate();
}

Termination paper_simplex_step(const Points& source, const Points& target, const L1FitOptions& options,
                               Eigen::Isometry3d& T_target_source, LpFigures& figures) {
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
    const L1FitResult fit = fit_l1(A * basis, d, options);
    figures += figures_of(fit);
    if (!fit.optimal()) return termination_of(fit.status);
    linear.row(axis) = (basis * fit.x).head<3>().transpose() / radius;
    objective += fit.objective;
  }
  figures.objective = objective;
  T_target_source.linear() = project_onto_so3(linear);  // the program leaves R linear, not orthonormal
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> rest(source.size());
    for (std::size_t i = 0; i < source.size(); ++i) {
      rest[i] = target[i][axis] - T_target_source.linear().row(axis).dot(source[i]);
    }
    T_target_source.translation()[axis] = median(rest);  // the L1 optimum of T for this R
  }
  return Termination::kConverged;
}

RegistrationResult register_paper(const Points& source, const Points& target, const NeighborIndex& target_index,
                                  const Eigen::Isometry3d& T_init, const PaperRegistrationOptions& options) {
  options.validate();
  RegistrationResult result;
  result.T_target_source = T_init;
  result.termination = Termination::kMaxIterations;
  if (source.size() < 4 || target.empty()) {
    result.termination = Termination::kTooFewCorrespondences;
    return result;
  }
  const double radius = rms_distance(source, centroid(source));
  Points matched(source.size());
  std::vector<double> distances(source.size());
  for (int i = 0; i < options.max_iterations; ++i) {
    for (std::size_t k = 0; k < source.size(); ++k) {
      const Neighbor q = target_index.nearest(result.T_target_source * source[k]);
      matched[k] = target[q.index];
      distances[k] = std::sqrt(q.squared_distance_m2);
    }
    result.num_correspondences = source.size();
    result.median_residual_m = median(distances);
    Eigen::Isometry3d next = result.T_target_source;
    const Termination step = paper_simplex_step(source, matched, options.lp, next, result.lp);
    if (step != Termination::kConverged) {
      result.termination = step;
      return result;
    }
    double moved = 0;
    for (const auto& p : source) moved += (next * p - result.T_target_source * p).squaredNorm();
    moved = std::sqrt(moved / static_cast<double>(source.size()));
    result.T_target_source = next;
    ++result.num_iterations;
    if (moved <= options.convergence_share * radius) {
      result.termination = Termination::kConverged;
      return result;
    }
  }
  return result;
}

}  // namespace tcm_icp
