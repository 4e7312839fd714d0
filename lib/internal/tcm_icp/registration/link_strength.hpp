#pragma once
// In which directions the points of two scans hold them against each other, and how firmly.

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// One principal direction of a link. The motion of unit length is (rotation vector [rad], translation [m]) about the
/// link's centre, the rotation measured by its arc at the link's radius.
struct LinkAxis {
  Eigen::Vector3d rotation_per_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  /// [m] slide after which the points are off their planes by the noise, root mean square: shorter ones cost less than
  /// the noise. Infinite where no point holds.
  double slide_m = std::numeric_limits<double>::infinity();
  double sigma_m = std::numeric_limits<double>::infinity();  ///< [m] standard deviation of this link by itself
};

struct LinkStrength {
  std::size_t num_matches = 0;                       ///< within the noise, both directions
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m] of these matches, in the common frame
  double radius_m = 0;                               ///< [m] their root mean square distance from it
  std::array<LinkAxis, 6> axes;                      ///< weakest first
};

/// Axes are those of the point-to-plane information matrix (Gelfand et al., 2003).
/// @param links    all of one pair of scans, in either direction
/// @param noise_m  [m] standard deviation of the residuals: those beyond 1.345 of it do not hold
/// @param block_m  [m] edge of the blocks whose errors count as independent, see JointUncertainty
LinkStrength link_strength(const std::vector<JointLink>& links, double noise_m, double block_m);

}  // namespace tcm_icp
