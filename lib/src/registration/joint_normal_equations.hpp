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

/// Huber's: 1 up to the threshold, then falling with the residual.
inline double huber_weight(double residual_m, double threshold_m) {
  return std::abs(residual_m) <= threshold_m ? 1 : threshold_m / std::abs(residual_m);
}

/// Weights are Huber's.
PoseSums huber_sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m);

class JointNormalEquations {
 public:
  /// @param frames    one a scan, of its unknowns; they outlive the equations
  /// @param fixed     the scan whose pose stays
  /// @param unknowns  of a scan: the six of its pose first
  JointNormalEquations(const std::vector<TwistFrame>& frames, std::size_t fixed, int unknowns = 6);

  /// How the two scans of a link move against each other is held by a millionth of the link's mean curvature: what its
  /// matches do not determine stays, and nothing else. A pose that is held by itself would hold a chain against
  /// bending, where a thousandth of a degree a link is metres at its end.
  template <int kUnknowns>
  void add(const JointLink& link, LinkSums<kUnknowns> sums) {
    const Matrix6 held = relative_motion(link);
    const double weight = kHeldShare * sums.ss.template topLeftCorner<6, 6>().trace() / 6;
    sums.tt.template topLeftCorner<6, 6>() += weight * held.transpose() * held;
    sums.ts.template topLeftCorner<6, 6>() += weight * held.transpose();
    sums.ss.template topLeftCorner<6, 6>().diagonal().array() += weight;
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
  static constexpr double kHeldShare = 1e-6;

  /// By the target's step, in units of the source's; by the source's own it is the identity.
  Matrix6 relative_motion(const JointLink& link) const;
  void add_block(std::size_t row, std::size_t column, const Eigen::Ref<const Eigen::MatrixXd>& block);
  void add_rhs(std::size_t row, const Eigen::Ref<const Eigen::VectorXd>& part);
  int place(std::size_t scan, int unknown) const { return unknowns_ * static_cast<int>(scan) + unknown; }
  bool is_fixed(std::size_t scan, int unknown) const { return scan == fixed_ && unknown < 6; }

  const std::vector<TwistFrame>& frames_;
  std::size_t fixed_;
  int unknowns_;
  double trace_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd rhs_;
};

}  // namespace tcm_icp
