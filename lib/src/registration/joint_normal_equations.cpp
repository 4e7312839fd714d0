#include "registration/joint_normal_equations.hpp"

#include <Eigen/SparseCholesky>

#include "core/cross_matrix.hpp"

namespace tcm_icp {
namespace {

// Of the mean curvature: holds scans that nothing ties to the fixed one, far below what holds the ends of a long chain,
// which falls with the fourth power of its length (7e-8 for 250 scans).
constexpr double kShareThatHolds = 1e-12;

}  // namespace

PoseSums huber_sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m) {
  PoseSums sums;
  for (const auto& match : link.matches) {
    const double r = residual_m(match);
    const double weight = huber_weight(r, threshold_m);
    const Twist js = residual_gradient(match, source), jt = -residual_gradient(match, target);
    sums.tt += weight * jt * jt.transpose();
    sums.ts += weight * jt * js.transpose();
    sums.ss += weight * js * js.transpose();
    sums.t -= weight * r * jt;
    sums.s -= weight * r * js;
  }
  return sums;
}

JointNormalEquations::JointNormalEquations(const std::vector<TwistFrame>& frames, std::size_t fixed, int unknowns)
    : frames_(frames),
      fixed_(fixed),
      unknowns_(unknowns),
      rhs_(Eigen::VectorXd::Zero(unknowns * static_cast<Eigen::Index>(frames.size()))) {}

Matrix6 JointNormalEquations::relative_motion(const JointLink& link) const {
  const TwistFrame &target = frames_[link.target], &source = frames_[link.source];
  Matrix6 motion = -Matrix6::Identity();
  motion.topLeftCorner<3, 3>() *= source.radius_m / target.radius_m;
  motion.bottomLeftCorner<3, 3>() = cross_matrix(source.centre - target.centre) / target.radius_m;
  return motion;
}

void JointNormalEquations::add_prior(std::size_t scan, int unknown, double weight, double step) {
  const int at = place(scan, unknown);
  entries_.emplace_back(at, at, weight);
  rhs_[at] += weight * step;
}

void JointNormalEquations::add_block(std::size_t row, std::size_t column,
                                     const Eigen::Ref<const Eigen::MatrixXd>& block) {
  // The factorization reads the lower triangle.
  for (int i = 0; i < unknowns_; ++i) {
    for (int j = 0; j < unknowns_ && place(column, j) <= place(row, i); ++j) {
      if (is_fixed(row, i) || is_fixed(column, j)) continue;
      entries_.emplace_back(place(row, i), place(column, j), block(i, j));
    }
  }
}

void JointNormalEquations::add_rhs(std::size_t row, const Eigen::Ref<const Eigen::VectorXd>& part) {
  for (int i = 0; i < unknowns_; ++i) {
    if (!is_fixed(row, i)) rhs_[place(row, i)] += part[i];
  }
}

Eigen::VectorXd JointNormalEquations::solve() {
  const double damping = kShareThatHolds * trace_ / static_cast<double>(6 * frames_.size()) + 1e-300;
  for (int i = 0; i < rhs_.size(); ++i) entries_.emplace_back(i, i, damping);
  Eigen::SparseMatrix<double> matrix(rhs_.size(), rhs_.size());
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  const Eigen::VectorXd x = factors.solve(rhs_);
  return factors.info() == Eigen::Success && x.allFinite() ? x : Eigen::VectorXd();
}

}  // namespace tcm_icp
