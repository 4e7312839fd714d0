#include "sweep_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decompositions.hpp"

namespace tcm_icp {
namespace {

using Step = Eigen::Matrix<double, 5, 1>;  // centre, axis across itself
using Information = Eigen::Matrix<double, 5, 5>;

// Geman-McClure's scale shrinks from the residuals of a start to those of good pieces.
constexpr double kFirstScale = 0.2, kLastScale = 0.01, kShrink = 0.85;
constexpr int kSteps = 25;
constexpr double kDamping = 1e-9;

Eigen::Matrix<double, 3, 2> across(const Eigen::Vector3d& axis) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = axis.unitOrthogonal();
  basis.col(1) = axis.cross(basis.col(0));
  return basis;
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
    const Eigen::Vector3d n = a * square - r * along;
    const double length = n.norm();
    if (!(length > 0)) continue;
    const double e = t.dot(n) / length;
    const Eigen::Vector3d g = (t - e / length * n) / length;  // of e, by n
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

double sweep_residual(const Sweep& sweep, const Eigen::Vector3d& middle, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d r = middle - sweep.centre;
  const Eigen::Vector3d n = sweep.axis * r.squaredNorm() - r * sweep.axis.dot(r);
  const double length = n.norm();
  return length > 0 ? direction.dot(n) / length : 1;
}

double share_of_sweep(const Sweep& sweep, const LinePieces& pieces, double tolerance, std::size_t stride) {
  std::size_t good = 0, all = 0;
  for (std::size_t i = 0; i < pieces.middles.size(); i += stride) {
    ++all;
    good += std::abs(sweep_residual(sweep, pieces.middles[i], pieces.directions[i])) < tolerance ? 1 : 0;
  }
  return all == 0 ? 0 : static_cast<double>(good) / static_cast<double>(all);
}

Eigen::Vector3d likely_axis(const LinePieces& pieces) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& t : pieces.directions) sum += t * t.transpose();
  return symmetric_eigen3(sum).vectors.col(0);
}

Sweep fit_sweep(const Sweep& start, const LinePieces& pieces, std::size_t stride) {
  Sweep sweep = start;
  sweep.sigma = std::numeric_limits<double>::infinity();
  double scale = kFirstScale;
  for (int k = 0; k < kSteps; ++k, scale = std::max(kLastScale, kShrink * scale)) {
    Normals sum = normal_equations(sweep, pieces, stride, scale);
    sum.information.diagonal().array() += kDamping * sum.information.trace();
    const Eigen::LDLT<Information> solver(sum.information);
    const Step step = solver.solve(sum.gradient);
    if (!step.allFinite() || !(sum.weight > 5)) return start;
    if (k + 1 == kSteps) {
      const Information covariance = sum.square / (sum.weight - 5) * solver.solve(Information::Identity());
      const Eigen::Matrix3d of_centre = covariance.topLeftCorner<3, 3>();
      sweep.sigma = std::sqrt(symmetric_eigen3(of_centre).values[2]);
    }
    sweep.centre -= step.head<3>();
    sweep.axis = (sweep.axis - across(sweep.axis) * step.tail<2>()).normalized();
  }
  return sweep;
}

}  // namespace tcm_icp
