#include "tcm_icp/core/rigid_transform.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <limits>

namespace tcm_icp {

Eigen::Isometry3d isometry_from_twist(const Twist& twist) { return isometry_about(Eigen::Vector3d::Zero(), twist); }

Eigen::Isometry3d isometry_about(const Eigen::Vector3d& centre, const Twist& twist) {
  const Eigen::Vector3d rotation_vector = twist.head<3>();
  const double angle = rotation_vector.norm();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (angle > 0) T.linear() = Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
  T.translation() = centre - T.linear() * centre + twist.tail<3>();
  return T;
}

double rotation_angle_rad(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d skew(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                             rotation(1, 0) - rotation(0, 1));
  return std::atan2(skew.norm() / 2, (rotation.trace() - 1) / 2);
}

Eigen::Matrix3d project_onto_so3(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

bool is_rigid(const Eigen::Matrix4d& m, double tolerance) {
  if (!m.allFinite()) return false;
  const Eigen::Matrix3d R = m.topLeftCorner<3, 3>();
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= tolerance && R.determinant() > 0 &&
         (m.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() <= tolerance;
}

double rms_displacement(const Eigen::Isometry3d& E, const Points& points) {
  if (points.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const auto& p : points) sum += (E * p - p).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

PointMoments::PointMoments(const Points& points) {
  const auto count = static_cast<double>(points.size());
  for (const auto& p : points) mean += p;
  mean /= count;
  for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose();
  covariance /= count;
}

// E p - p = A p + t with A = R - I: its mean square is that of the mean point, and what A makes of the spread.
double rms_displacement(const Eigen::Isometry3d& E, const PointMoments& moments) {
  const Eigen::Matrix3d A = E.linear() - Eigen::Matrix3d::Identity();
  return std::sqrt((A * moments.mean + E.translation()).squaredNorm() +
                   (A * moments.covariance * A.transpose()).trace());
}

Cloud transformed(const Cloud& cloud, const Eigen::Isometry3d& T_target_source) {
  Cloud out;
  out.points.reserve(cloud.points.size());
  out.normals.reserve(cloud.normals.size());
  for (const auto& p : cloud.points) out.points.push_back(T_target_source * p);
  for (const auto& n : cloud.normals) out.normals.push_back(T_target_source.linear() * n);
  return out;
}

}  // namespace tcm_icp
