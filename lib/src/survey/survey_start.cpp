#include "survey/survey_start.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

constexpr double kLine = 0.02;  // of the length: points no wider than that lie on a line, for a first guess

Eigen::Matrix3d about_vertical(const Eigen::Matrix3d& H) {
  const double angle = std::atan2(H(1, 0) - H(0, 1), H(0, 0) + H(1, 1));
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

Eigen::Isometry3d start_of_survey(const ScanNetwork& network, const SurveyObservations& observations,
                                  const std::vector<bool>& used) {
  if (!observations.poses.empty()) {
    const PoseObservation& first = observations.poses.front();
    return first.T_survey_scan * network.T_local_scan[first.scan].inverse();
  }
  Points local, given;
  for (std::size_t k = 0; k < observations.points.size(); ++k) {
    if (!used[k]) continue;
    const PointObservation& p = observations.points[k];
    local.push_back(p.scan == kNoScan ? p.measured : network.T_local_scan[p.scan] * p.measured);
    given.push_back(p.given);
  }
  const Eigen::Vector3d middle_local = PointMoments(local).mean, middle_given = PointMoments(given).mean;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();  // given from local
  for (std::size_t k = 0; k < local.size(); ++k) {
    H += (given[k] - middle_given) * (local[k] - middle_local).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& lengths = svd.singularValues();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (!observations.levels.empty()) {
    R = about_vertical(H);
  } else if (lengths[1] > kLine * kLine * lengths[0]) {
    R = project_onto_so3(H);
  } else if (lengths[0] > 0) {
    R = Eigen::Quaterniond::FromTwoVectors(svd.matrixV().col(0), svd.matrixU().col(0)).toRotationMatrix();
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R;
  T.translation() = middle_given - R * middle_local;
  return T;
}

}  // namespace tcm_icp
