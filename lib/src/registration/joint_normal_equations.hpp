#pragma once
// Gauss-Newton's equations of a joint adjustment: blocks of six unknowns a scan, one scan fixed.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <vector>

#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What one link adds: target and source blocks of J'WJ, and of -J'Wr.
template <int kUnknowns>
struct LinkSums {
  using Block = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  using Part = Eigen::Matrix<double, kUnknowns, 1>;
  Block tt = Block::Zero(), ts = Block::Zero(), ss = Block::Zero();
  Part t = Part::Zero(), s = Part::Zero();
};
using PoseSums = LinkSums<6>;

/// How the two scans of a link move against each other is held by a millionth of the link's mean curvature: what its
/// matches do not determine stays, and nothing else. A pose that is held by itself would hold a chain against bending,
/// where a thousandth of a degree a link is metres at its end.
template <int kUnknowns>
void hold_relative_motion(const TwistFrame& target, const TwistFrame& source, LinkSums<kUnknowns>& sums) {
  constexpr double kShare = 1e-6;
  Matrix6 of_target = -Matrix6::Identity();  // motion of the target in the source's frame, taken off
  const Eigen::Vector3d d = source.centre - target.centre;
  of_target.topLeftCorner<3, 3>() *= source.radius_m / target.radius_m;
  Eigen::Matrix3d across;
  across << 0, -d.z(), d.y(), d.z(), 0, -d.x(), -d.y(), d.x(), 0;
  of_target.bottomLeftCorner<3, 3>() = across / target.radius_m;  // -(rotation x d)
  const double weight = kShare * sums.ss.template topLeftCorner<6, 6>().trace() / 6;
  sums.tt.template topLeftCorner<6, 6>() += weight * of_target.transpose() * of_target;
  sums.ts.template topLeftCorner<6, 6>() += weight * of_target.transpose();
  sums.ss.template topLeftCorner<6, 6>().diagonal().array() += weight;
}

/// Huber's: 1 up to the threshold, then falling with the residual.
inline double huber_weight(double residual_m, double threshold_m) {
  return std::abs(residual_m) <= threshold_m ? 1 : threshold_m / std::abs(residual_m);
}

/// Weights are Huber's.
PoseSums huber_sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m);

class JointNormalEquations {
 public:
  /// @param fixed     the scan whose pose stays
  /// @param unknowns  of a scan: the six of its pose first
  JointNormalEquations(std::size_t num_scans, std::size_t fixed, int unknowns = 6);

  template <int kUnknowns>
  void add(const JointLink& link, const LinkSums<kUnknowns>& sums) {
    add_block(link.target, link.target, sums.tt);
    add_block(link.target, link.source, sums.ts);
    add_block(link.source, link.target, sums.ts.transpose());
    add_block(link.source, link.source, sums.ss);
    add_rhs(link.target, sums.t);
    add_rhs(link.source, sums.s);
    trace_ += sums.ss.template topLeftCorner<6, 6>().trace();
  }

  /// What is known of an unknown of a scan beforehand: that its step comes to `step`, with this weight.
  void add_prior(std::size_t scan, int unknown, double weight, double step);

  /// Zero for the fixed pose and for scans without links; empty where the matrix cannot be factorised.
  Eigen::VectorXd solve();

 private:
  void add_block(std::size_t row, std::size_t column, const Eigen::Ref<const Eigen::MatrixXd>& block);
  void add_rhs(std::size_t row, const Eigen::Ref<const Eigen::VectorXd>& part);
  int place(std::size_t scan, int unknown) const { return unknowns_ * static_cast<int>(scan) + unknown; }
  bool is_fixed(std::size_t scan, int unknown) const { return scan == fixed_ && unknown < 6; }

  std::size_t num_scans_, fixed_;
  int unknowns_;
  double trace_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd rhs_;
};

}  // namespace tcm_icp
