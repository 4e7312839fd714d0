#include "registration/joint_normal_equations.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace tcm_icp {

LinkSums huber_sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m) {
  LinkSums sums;
  for (const auto& match : link.matches) {
    const double r = residual_m(match);
    const double weight = std::abs(r) <= threshold_m ? 1 : threshold_m / std::abs(r);
    const Twist js = residual_gradient(match, source), jt = -residual_gradient(match, target);
    sums.tt += weight * jt * jt.transpose();
    sums.ts += weight * jt * js.transpose();
    sums.ss += weight * js * js.transpose();
    sums.t -= weight * r * jt;
    sums.s -= weight * r * js;
  }
  return sums;
}

JointNormalEquations::JointNormalEquations(std::size_t num_scans, std::size_t fixed)
    : num_scans_(num_scans), fixed_(fixed), rhs_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * num_scans))) {}

void JointNormalEquations::add(const JointLink& link, const LinkSums& sums) {
  add_block(link.target, link.target, sums.tt);
  add_block(link.target, link.source, sums.ts);
  add_block(link.source, link.target, sums.ts.transpose());
  add_block(link.source, link.source, sums.ss);
  add_rhs(link.target, sums.t);
  add_rhs(link.source, sums.s);
  trace_ += sums.ss.trace();
}

void JointNormalEquations::add_block(std::size_t row, std::size_t column, const Matrix6& block) {
  if (row == fixed_ || column == fixed_) return;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      entries_.emplace_back(static_cast<int>(6 * row) + i, static_cast<int>(6 * column) + j, block(i, j));
    }
  }
}

void JointNormalEquations::add_rhs(std::size_t row, const Twist& part) {
  if (row != fixed_) rhs_.segment<6>(static_cast<Eigen::Index>(6 * row)) += part;
}

Eigen::VectorXd JointNormalEquations::solve() {
  const double damping = 1e-6 * trace_ / static_cast<double>(6 * num_scans_) + 1e-300;
  for (int i = 0; i < rhs_.size(); ++i) entries_.emplace_back(i, i, damping);
  Eigen::SparseMatrix<double> matrix(rhs_.size(), rhs_.size());
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  const Eigen::VectorXd x = factors.solve(rhs_);
  return factors.info() == Eigen::Success && x.allFinite() ? x : Eigen::VectorXd();
}

}  // namespace tcm_icp
