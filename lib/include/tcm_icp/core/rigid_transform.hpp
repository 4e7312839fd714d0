#pragma once
// Rigid motions: T_target_source maps source coordinates into target.

#include <Eigen/Geometry>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Twist (rotation vector [rad], translation [m]).
using Twist = Eigen::Matrix<double, 6, 1>;

/// x -> R(rotation vector) x + translation. The rotation is exp on SO(3); the translation is taken as it is.
Eigen::Isometry3d isometry_from_twist(const Twist& twist);

/// The same motion taken about `centre`: x -> R (x - centre) + centre + translation.
Eigen::Isometry3d isometry_about(const Eigen::Vector3d& centre, const Twist& twist);

/// Angle of a rotation [rad], 0..pi; atan2 keeps full precision near both ends.
double rotation_angle_rad(const Eigen::Matrix3d& rotation);

/// The rotation nearest to `m` in the Frobenius norm (SVD, Umeyama's sign). det = +1 always.
Eigen::Matrix3d project_onto_so3(const Eigen::Matrix3d& m);

/// True where the upper 3 x 3 block is orthonormal with det +1 and the last row is 0 0 0 1, all within `tolerance`.
bool is_rigid(const Eigen::Matrix4d& m, double tolerance);

/// Root mean square distance [m] that `E` moves `points` by; NaN where there are none.
double rms_displacement(const Eigen::Isometry3d& E, const Points& points);

/// What of a set of points decides how far a rigid motion moves them in the mean.
struct PointMoments {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< [m]; NaN where there are no points
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2], about the mean

  PointMoments() = default;  ///< of a single point at the origin
  /// Of these points.
  PointMoments(const Points& points);  // NOLINT: points have moments, whoever asks for them
};

/// The same from the points' moments, in constant time.
double rms_displacement(const Eigen::Isometry3d& E, const PointMoments& moments);

/// Points and normals moved by T_target_source.
Cloud transformed(const Cloud& cloud, const Eigen::Isometry3d& T_target_source);

}  // namespace tcm_icp
