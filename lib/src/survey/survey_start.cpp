#include "survey/survey_start.hpp"

#include <cmath>

#include "core/decompositions.hpp"
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
                                  const UsedObservations& used) {
  for (std::size_t k = 0; k < observations.poses.size(); ++k) {
    const PoseObservation& pose = observations.poses[k];
    if (used.poses[k]) return pose.T_survey_scan * network.T_local_scan[pose.scan].inverse();
  }
  Points local, given;
  for (std::size_t k = 0; k < observations.points.size(); ++k) {
    if (!used.points[k]) continue;
    const PointObservation& p = observations.points[k];
    local.push_back(p.scan == kNoScan ? p.measured : network.T_local_scan[p.scan] * p.measured);
    given.push_back(p.given);
  }
  const Eigen::Vector3d middle_local = PointMoments(local).mean, middle_given = PointMoments(given).mean;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();  // given from local
  for (std::size_t k = 0; k < local.size(); ++k) {
    H += (given[k] - middle_given) * (local[k] - middle_local).transpose();
  }
  const SingularValues3 svd = singular_values3(H);
  const Eigen::Vector3d& lengths = svd.values;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (!observations.levels.empty()) {
    R = about_vertical(H);
  } else if (lengths[1] > kLine * kLine * lengths[0]) {
    R = project_onto_so3(H);
  } else if (lengths[0] > 0) {
    R = rotation_between(svd.V.col(0), svd.U.col(0));
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R;
  T.translation() = middle_given - R * middle_local;
  return T;
}

}  // namespace tcm_icp
