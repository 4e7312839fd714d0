#pragma once
// How well the poses of a joint adjustment are determined.

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// Of one scan's pose in the frame of the fixed scan: covariance of the twist (rotation vector [rad] about `centre`,
/// translation [m]) that would make it right, along the axes of the common frame.
struct PoseUncertainty {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m] the scan's middle
  Eigen::Matrix<double, 6, 6> covariance =
      Eigen::Matrix<double, 6, 6>::Constant(std::numeric_limits<double>::quiet_NaN());
  bool determined = false;  ///< false: it could be off by its own size, and the covariance is NaN

  /// Standard deviations along x, y, z [rad], [m].
  Eigen::Vector3d sigma_rotation_rad() const { return covariance.diagonal().head<3>().cwiseSqrt(); }
  Eigen::Vector3d sigma_position_m() const { return covariance.diagonal().tail<3>().cwiseSqrt(); }
};

struct JointUncertainty {
  std::vector<PoseUncertainty> poses;  ///< one a scan; zero for the fixed one
  double noise_m = 0;                  ///< [m] robust standard deviation of the residuals
  double block_m = 0;                  ///< [m] edge of the blocks whose errors count as independent
  /// By how much the standard deviations grew because neighbouring residuals are correlated, on average: 1 were they
  /// independent.
  double correlation_factor = 1;
  /// And because links disagree by more than their blocks explain: >= 1; 1 where no loop can tell.
  double disagreement_factor = 1;
  /// [m^2] of all scans' steps about their frames, 6 n x 6 n, zero for the fixed scan; empty unless asked for.
  Eigen::MatrixXd joint_covariance_m2;
};

struct PoseCovarianceOptions {
  double smallest_block_m = 0;          ///< [m] > 0; the resolution of the points
  std::size_t min_blocks_of_scan = 30;  ///< >= 7; larger blocks are not tried once the typical scan has fewer
  bool keeps_joint = false;             ///< the covariance of all scans together, too
  void validate() const;                ///< throws InvalidOptions
};

/// Covariance H^-1 M H^-1 of Huber's estimate (Huber, 1967) at the poses the matches were found at, the fixed scan's
/// pose taken for exact: H of the residuals within 1.345 sigma, M the sum over blocks of the outer products of their
/// scores. Blocks are cubes whose edge doubles from smallest_block_m; kept is the one that gives the largest variances,
/// for the variance grows with the edge until blocks are independent (Flyvbjerg and Petersen, 1989). The whole is
/// scaled by how much the links of loops contradict one another, as surveyors do with their variance of unit weight.
///
/// Errors that all links of a scan share (a scale error, a scan bent by motion the same way in each) show in neither.
/// @param frames  of each scan, at its present pose
/// @throws InvalidOptions, InvalidInput  if a link names a scan there is none of
/// Cost: a sparse factorization and two solutions for each scan; O(N log N) in the number of matches for each of a few
/// edges; O(n^3) in the number of scans where the joint covariance is kept. Thread-safe.
JointUncertainty estimate_uncertainty(const std::vector<TwistFrame>& frames, std::size_t fixed,
                                      const std::vector<JointLink>& links, const PoseCovarianceOptions& options,
                                      int num_threads = 1);

}  // namespace tcm_icp
