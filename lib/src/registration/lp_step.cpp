#include <cmath>

#include "determined_directions.hpp"
#include "lp_figures.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/lp_registration.hpp"
#include "tcm_icp/registration/paper_registration.hpp"

namespace tcm_icp {
namespace {

// Rows A x = d in the unknowns x = (w radius, t), all in metres: rotation about the matches' centroid, translation.
struct TwistRows {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0;
  Eigen::MatrixXd A;
  Eigen::VectorXd d;
};

TwistRows empty_rows(const Correspondences& matches) {
  TwistRows rows;
  for (const auto& m : matches) rows.centre += m.source;
  rows.centre /= static_cast<double>(matches.size());
  double squared_radius = 0;
  for (const auto& m : matches) squared_radius += (m.source - rows.centre).squaredNorm();
  rows.radius_m = std::sqrt(squared_radius / static_cast<double>(matches.size()));
  return rows;
}

// direction . (p + w x (p - c) + t - q) = 0 as row i.
void set_row(TwistRows& rows, Eigen::Index i, const Correspondence& m, const Eigen::Vector3d& direction) {
  // n . (w x (p - c)) = w . ((p - c) x n)
  rows.A.row(i).head<3>() = (m.source - rows.centre).cross(direction).transpose() / rows.radius_m;
  rows.A.row(i).tail<3>() = direction.transpose();
  rows.d[i] = -direction.dot(m.source - m.target);
}

TwistRows plane_rows(const Correspondences& matches) {
  TwistRows rows = empty_rows(matches);
  const auto n = static_cast<Eigen::Index>(matches.size());
  rows.A.resize(n, 6);
  rows.d.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Correspondence& m = matches[static_cast<std::size_t>(i)];
    set_row(rows, i, m, m.normal);
  }
  return rows;
}

TwistRows point_rows(const Correspondences& matches) {
  TwistRows rows = empty_rows(matches);
  const auto n = static_cast<Eigen::Index>(matches.size());
  rows.A.resize(3 * n, 6);
  rows.d.resize(3 * n);
  for (Eigen::Index i = 0; i < 3 * n; ++i) {
    set_row(rows, i, matches[static_cast<std::size_t>(i / 3)], Eigen::Vector3d::Unit(i % 3));
  }
  return rows;
}

void apply(const TwistRows& rows, Twist twist, Eigen::Isometry3d& T_target_source, double& step_m) {
  step_m = twist.norm();
  twist.head<3>() /= rows.radius_m;
  T_target_source = isometry_about(rows.centre, twist) * T_target_source;
  // Thousands of products drift off SO(3) by rounding.
  T_target_source.linear() = project_onto_so3(T_target_source.linear());
}

Termination simplex_step(const TwistRows& rows, const L1FitOptions& options, Eigen::Isometry3d& T_target_source,
                         LpFigures& figures, double& step_m) {
  if (!(rows.radius_m > 0)) return Termination::kTooFewCorrespondences;
  // Where all normals are parallel but for rounding, fit_l1 would scale the rounding up to a determined column, and the
  // scan would slide away without end.
  const Eigen::MatrixXd basis = determined_directions(rows.A, options.rank_tolerance);
  const L1FitResult fit = fit_l1(rows.A * basis, rows.d, options);
  figures += figures_of(fit);
  if (!fit.optimal()) return termination_of(fit.status);
  apply(rows, basis * fit.x, T_target_source, step_m);
  return Termination::kConverged;
}

Termination least_squares_step(const TwistRows& rows, const L1FitOptions& options, Eigen::Isometry3d& T_target_source,
                               double& step_m) {
  if (!(rows.radius_m > 0)) return Termination::kTooFewCorrespondences;
  const Eigen::MatrixXd basis = determined_directions(rows.A, options.rank_tolerance);
  apply(rows, basis * (rows.A * basis).colPivHouseholderQr().solve(rows.d), T_target_source, step_m);
  return Termination::kConverged;
}

Termination entries_step(const Correspondences& matches, const L1FitOptions& options,
                         Eigen::Isometry3d& T_target_source, LpFigures& figures, double& step_m) {
  Points source, target;
  for (const auto& m : matches) {
    source.push_back(m.source);
    target.push_back(m.target);
  }
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  const Termination termination = paper_simplex_step(source, target, options, step, figures);
  if (termination != Termination::kConverged) return termination;
  step_m = rms_displacement(step, source);
  T_target_source = step * T_target_source;
  T_target_source.linear() = project_onto_so3(T_target_source.linear());
  return termination;
}

}  // namespace

Termination lp_point_to_plane_step(const Correspondences& matches, const L1FitOptions& options,
                                   Eigen::Isometry3d& T_target_source, LpFigures& figures, double& step_m) {
  return simplex_step(plane_rows(matches), options, T_target_source, figures, step_m);
}

Termination registration_step(LpFormulation formulation, const Correspondences& matches, const L1FitOptions& options,
                              Eigen::Isometry3d& T_target_source, LpFigures& figures, double& step_m) {
  switch (formulation) {
    case LpFormulation::kPointToPlane:
      return lp_point_to_plane_step(matches, options, T_target_source, figures, step_m);
    case LpFormulation::kPointToPoint:
      return simplex_step(point_rows(matches), options, T_target_source, figures, step_m);
    case LpFormulation::kEntries:
      return entries_step(matches, options, T_target_source, figures, step_m);
    case LpFormulation::kLeastSquares:
      return least_squares_step(plane_rows(matches), options, T_target_source, step_m);
  }
  return Termination::kNotRun;
}

}  // namespace tcm_icp
