#include "sweep_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/decompositions.hpp"

namespace tcm_icp {
namespace {

using Step = Eigen::Matrix<double, 5, 1>;  // centre, axis across itself
using Information = Eigen::Matrix<double, 5, 5>;

// Geman-McClure's scale shrinks to the residuals of good pieces.
constexpr double kLastScale = 0.01, kShrink = 0.85;
constexpr int kMostSteps = 25;
constexpr double kLastStep = 1e-5;  // of the centre, in units of the frame
constexpr double kDamping = 1e-9;
constexpr double kLeastSlope = 0.1;  // sine of the angle between the plane and the cone

Eigen::Matrix<double, 3, 2> across(const Eigen::Vector3d& axis) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = axis.unitOrthogonal();
  basis.col(1) = axis.cross(basis.col(0));
  return basis;
}

// In the plane of the points, at a right angle to the row that a beam at r from the centre draws there: so pieces that
// are off by chance are so to either side, whatever the centre. Nothing where the cone touches the plane.
std::optional<Eigen::Vector3d> across_row(const Sweep& sweep, const Eigen::Vector3d& r, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d n = sweep.axis * r.squaredNorm() - r * sweep.axis.dot(r);
  const Eigen::Vector3d along_plane = n - normal * normal.dot(n);
  if (!(along_plane.squaredNorm() > kLeastSlope * kLeastSlope * n.squaredNorm())) return std::nullopt;
  return along_plane;
}

struct Normals {
  Information information = Information::Zero();  ///< its lower half, which is what its factors are made of
  Step gradient = Step::Zero();
  double square = 0, weight = 0;
};

Normals normal_equations(const Sweep& sweep, const LinePieces& pieces, std::size_t stride, double scale) {
  const Eigen::Matrix<double, 3, 2> basis = across(sweep.axis);
  const Eigen::Vector3d& a = sweep.axis;
  Normals sum;
  for (std::size_t i = 0; i < pieces.middles.size(); i += stride) {
    const Eigen::Vector3d r = pieces.middles[i] - sweep.centre;
    const Eigen::Vector3d& t = pieces.directions[i];
    const double along = a.dot(r), square = r.squaredNorm();
    const std::optional<Eigen::Vector3d> n = across_row(sweep, r, pieces.normals[i]);
    if (!n) continue;
    const double length = n->norm(), e = t.dot(*n) / length;
    const Eigen::Vector3d g = (t - e / length * *n) / length;  // of e, by n; along the plane, as t is
    Step slope;
    slope.head<3>() = -(2 * g.dot(a) * r - along * g - g.dot(r) * a);
    slope.tail<2>() = basis.transpose() * (square * g - g.dot(r) * r);
    const double inlier = 1 / (1 + e * e / (scale * scale));
    const double w = inlier * inlier;
    const Step weighted = w * slope;
    for (int column = 0; column < 5; ++column) {
      for (int row = column; row < 5; ++row) sum.information(row, column) += weighted[row] * slope[column];
    }
    sum.gradient += w * e * slope;
    sum.square += w * e * e;
    sum.weight += w;
  }
  return sum;
}

}  // namespace

std::optional<double> sweep_residual(const Sweep& sweep, const LinePieces& pieces, std::size_t i) {
  const auto n = across_row(sweep, pieces.middles[i] - sweep.centre, pieces.normals[i]);
  if (!n) return std::nullopt;
  return pieces.directions[i].dot(*n) / n->norm();
}

SweepSupport support_of_sweep(const Sweep& sweep, const LinePieces& pieces, double tolerance) {
  SweepSupport support;
  for (std::size_t i = 0; i < pieces.middles.size(); ++i) {
    const std::optional<double> off_row = sweep_residual(sweep, pieces, i);
    if (!off_row) continue;
    const Eigen::Vector3d off_plane = sweep.axis.cross(pieces.middles[i] - sweep.centre).stableNormalized();
    if (std::abs(*off_row) < tolerance) {
      ++support.rows;
    } else if (!(std::abs(pieces.directions[i].dot(off_plane)) < tolerance)) {
      ++support.others;
    }
  }
  return support;
}

Eigen::Vector3d likely_axis(const Eigen::Vector3d& centre, const LinePieces& pieces) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < pieces.middles.size(); ++i) {
    const Eigen::Vector3d ray = (pieces.middles[i] - centre).stableNormalized();
    const Eigen::Vector3d t = pieces.directions[i] - ray * ray.dot(pieces.directions[i]);
    sum += t * t.transpose();
  }
  return symmetric_eigen3(sum).vectors.col(0);
}

Sweep fit_sweep(const Sweep& start, const LinePieces& pieces, std::size_t stride, double scale) {
  Sweep sweep = start;
  sweep.sigma = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostSteps; ++k, scale = std::max(kLastScale, kShrink * scale)) {
    Normals sum = normal_equations(sweep, pieces, stride, scale);
    sum.information.diagonal().array() += kDamping * sum.information.trace();
    const Eigen::LDLT<Information> solver(sum.information);
    const Step step = solver.solve(sum.gradient);
    if (!step.allFinite() || !(sum.weight > 5)) return start;
    sweep.centre -= step.head<3>();
    sweep.axis = (sweep.axis - across(sweep.axis) * step.tail<2>()).normalized();
    if (k + 1 < kMostSteps && !(scale == kLastScale && step.head<3>().norm() < kLastStep)) continue;
    const Information covariance = sum.square / (sum.weight - 5) * solver.solve(Information::Identity());
    const Eigen::Matrix3d of_centre = covariance.topLeftCorner<3, 3>();
    sweep.sigma = std::sqrt(symmetric_eigen3(of_centre).values[2]);
    break;
  }
  return sweep;
}

}  // namespace tcm_icp
