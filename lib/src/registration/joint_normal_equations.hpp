#pragma once
// Gauss-Newton's equations of a joint adjustment: blocks of six unknowns a scan, one scan fixed.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What one link adds: target and source blocks of J'WJ, and of -J'Wr.
struct LinkSums {
  Matrix6 tt = Matrix6::Zero(), ts = Matrix6::Zero(), ss = Matrix6::Zero();
  Twist t = Twist::Zero(), s = Twist::Zero();
};

/// Weights are Huber's: 1 up to `threshold_m`, then falling with the residual.
LinkSums huber_sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m);

class JointNormalEquations {
 public:
  JointNormalEquations(std::size_t num_scans, std::size_t fixed);

  void add(const JointLink& link, const LinkSums& sums);

  /// Zero for the fixed scan and for scans without links; empty where the matrix cannot be factorised. A millionth of
  /// the mean curvature on the diagonal holds still what the matches do not determine, and nothing else.
  Eigen::VectorXd solve();

 private:
  void add_block(std::size_t row, std::size_t column, const Matrix6& block);
  void add_rhs(std::size_t row, const Twist& part);

  std::size_t num_scans_, fixed_;
  double trace_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd rhs_;
};

}  // namespace tcm_icp
