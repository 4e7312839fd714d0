#pragma once
// Covariance of Huber's joint estimate: its curvature on both sides of the scatter of its scores. Both are sparse:
// scans that share no matches share no entries.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "registration/joint_normal_equations.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// Sum over blocks of matches of the outer products of their scores.
struct ScoreScatter {
  Eigen::SparseMatrix<double> matrix;  ///< 6 n x 6 n
  double blocks_of_scan = 0;           ///< that the typical scan has matches in
};

/// Keeps references: frames and links must outlive it.
class ScoreSandwich {
 public:
  /// @param noise_m  [m] standard deviation of the residuals; those beyond 1.345 of it are clamped and have no
  /// curvature
  ScoreSandwich(const std::vector<TwistFrame>& frames, std::size_t fixed, const std::vector<JointLink>& links,
                double noise_m);

  /// Of the matches in each cube of that edge, without the fixed scan's part.
  ScoreScatter scatter(double block_m) const;

  /// For each scatter, the sum over all unknowns of the variance by it, in units of what one unit of noise would give.
  /// A solution with six right sides for each scan.
  std::vector<double> variance_ratios(const std::vector<ScoreScatter>& scatters, int num_threads) const;

  /// Of each scan's step [m^2]. Very large where the matches do not determine it. As many solutions.
  std::vector<Matrix6> covariances(const ScoreScatter& scatter, int num_threads) const;

  /// Of all scans' steps together [m^2], 6 n x 6 n. O(n^3).
  Eigen::MatrixXd joint_covariance(const ScoreScatter& scatter) const;

 private:
  /// Columns of the inverse that belong to a scan, 6 n x 6.
  Eigen::MatrixXd inverse_columns(std::size_t scan) const;
  Eigen::Index size() const { return static_cast<Eigen::Index>(6 * frames_.size()); }

  const std::vector<TwistFrame>& frames_;
  std::size_t fixed_;
  const std::vector<JointLink>& links_;
  double noise_m_, damping_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace tcm_icp
