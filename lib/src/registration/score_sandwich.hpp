#pragma once
// Covariance of Huber's joint estimate: its curvature on both sides of the scatter of its scores.

#include <Eigen/Core>
#include <map>
#include <vector>

#include "registration/joint_normal_equations.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// Score of one block of matches: six numbers for each scan it has matches of.
using BlockScore = std::map<std::size_t, Twist>;

/// The 6 x 6 block of two scans.
inline Matrix6 scan_block(const Eigen::MatrixXd& matrix, std::size_t a, std::size_t b) {
  return matrix.block<6, 6>(static_cast<Eigen::Index>(6 * a), static_cast<Eigen::Index>(6 * b));
}

/// Keeps references: frames and links must outlive it.
class ScoreSandwich {
 public:
  /// @param noise_m  [m] standard deviation of the residuals; those beyond 1.345 of it are clamped and have no
  /// curvature
  ScoreSandwich(const std::vector<TwistFrame>& frames, std::size_t fixed, const std::vector<JointLink>& links,
                double noise_m);

  /// Of the matches in each cube of that edge, without the fixed scan's part.
  std::vector<BlockScore> scores(double block_m) const;

  /// Sum over all unknowns of the variance by the blocks' scatter, in units of what one unit of noise would give.
  double variance_ratio(const std::vector<BlockScore>& scores) const;

  /// Of all scans' steps [m^2]. Very large where the matches do not determine a step.
  Eigen::MatrixXd covariance(const std::vector<BlockScore>& scores) const;

 private:
  void add(std::size_t scan, const Twist& part, BlockScore& score) const;
  void add(const JointLink& link, const Correspondence& match, Eigen::MatrixXd& information) const;

  const std::vector<TwistFrame>& frames_;
  std::size_t fixed_;
  const std::vector<JointLink>& links_;
  double noise_m_, damping_ = 0;
  Eigen::MatrixXd inverse_;
};

}  // namespace tcm_icp
