#include "survey/survey_equations.hpp"

#include <cmath>

#include "core/cross_matrix.hpp"

namespace tcm_icp {

TwistFrame frame_of_network(const ScanNetwork& network) {
  const auto n = static_cast<double>(network.frames.size());
  TwistFrame out;
  for (const auto& frame : network.frames) out.centre += frame.centre / n;
  double square = 0;
  for (const auto& frame : network.frames) {
    square += ((frame.centre - out.centre).squaredNorm() + frame.radius_m * frame.radius_m) / n;
  }
  out.radius_m = std::sqrt(square);
  return out;
}

SurveyEquations::SurveyEquations(const ScanNetwork& network, const TwistFrame& whole,
                                 const SurveyObservations& observations, const UsedObservations& used,
                                 const Eigen::Isometry3d& T_survey_local)
    : frame_{T_survey_local * whole.centre, whole.radius_m} {
  auto rows = 2 * static_cast<Eigen::Index>(observations.levels.size());
  for (const bool is_used : used.points) rows += is_used ? 3 : 0;
  for (const bool is_used : used.poses) rows += is_used ? 6 : 0;
  row_of.assign(used.points.size(), -1);
  row_of_pose.assign(used.poses.size(), -1);
  y = Eigen::VectorXd::Zero(rows);
  A = Eigen::MatrixXd::Zero(rows, 6);
  R = Eigen::MatrixXd::Zero(rows, rows);
  const auto& points = observations.points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!used.points[k]) continue;
    row_of[k] = next_;
    add(network, points[k], T_survey_local);
  }
  // One given place, and one error of it, for all that have its name.
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < points.size(); ++b) {
      if (!used.points[a] || !used.points[b] || points[a].name != points[b].name) continue;
      R.block<3, 3>(row_of[a], row_of[b]).diagonal() += points[a].sigma_given_m.cwiseProduct(points[b].sigma_given_m);
    }
  }
  for (std::size_t k = 0; k < observations.poses.size(); ++k) {
    if (!used.poses[k]) continue;
    row_of_pose[k] = next_;
    add(network, observations.poses[k], T_survey_local);
  }
  for (const auto& level : observations.levels) add(network, level, T_survey_local);
  factorize(network);
}

void SurveyEquations::begin(Eigen::Index rows, std::size_t scan) {
  parts_.push_back({next_, rows, scan, Eigen::MatrixXd::Zero(rows, 6)});
  next_ += rows;
}

void SurveyEquations::add(const ScanNetwork& network, const PointObservation& point,
                          const Eigen::Isometry3d& T_survey_local) {
  begin(3, point.scan);
  Part& part = parts_.back();
  const bool in_scan = point.scan != kNoScan;
  const Eigen::Isometry3d T_local = in_scan ? network.T_local_scan[point.scan] : Eigen::Isometry3d::Identity();
  const Eigen::Vector3d local = T_local * point.measured, computed = T_survey_local * local;
  const Eigen::Matrix3d& turn = T_survey_local.linear();
  y.segment<3>(part.row) = point.given - computed;
  A.block<3, 3>(part.row, 0) = -cross_matrix(computed - frame_.centre) / frame_.radius_m;
  A.block<3, 3>(part.row, 3).setIdentity();
  const Eigen::Matrix3d axes = turn * T_local.linear();
  R.block<3, 3>(part.row, part.row) += axes * point.sigma_measured_m.cwiseAbs2().asDiagonal() * axes.transpose();
  if (!in_scan) return;
  const TwistFrame& frame = network.frames[point.scan];
  part.by_scan.leftCols<3>() = -turn * cross_matrix(local - frame.centre) / frame.radius_m;
  part.by_scan.rightCols<3>() = turn;
}

void SurveyEquations::add(const ScanNetwork& network, const PoseObservation& pose,
                          const Eigen::Isometry3d& T_survey_local) {
  begin(6, pose.scan);
  Part& part = parts_.back();
  const TwistFrame& frame = network.frames[pose.scan];
  const Eigen::Vector3d centre = T_survey_local * frame.centre;
  const Eigen::Isometry3d off = pose.T_survey_scan * (T_survey_local * network.T_local_scan[pose.scan]).inverse();
  const Eigen::AngleAxisd angle(off.linear());
  y.segment<3>(part.row) = frame.radius_m * angle.angle() * angle.axis();
  y.segment<3>(part.row + 3) = off * centre - centre;
  A.block<3, 3>(part.row, 0).diagonal().setConstant(frame.radius_m / frame_.radius_m);
  A.block<3, 3>(part.row + 3, 0) = -cross_matrix(centre - frame_.centre) / frame_.radius_m;
  A.block<3, 3>(part.row + 3, 3).setIdentity();
  part.by_scan.topLeftCorner<3, 3>() = part.by_scan.bottomRightCorner<3, 3>() = T_survey_local.linear();
  R.block<3, 3>(part.row, part.row).diagonal().setConstant(std::pow(frame.radius_m * pose.sigma_rotation_rad, 2));
  R.block<3, 3>(part.row + 3, part.row + 3).diagonal().setConstant(std::pow(pose.sigma_position_m, 2));
}

void SurveyEquations::add(const ScanNetwork& network, const LevelObservation& level,
                          const Eigen::Isometry3d& T_survey_local) {
  begin(2, level.scan);
  Part& part = parts_.back();
  const Eigen::Vector3d up = T_survey_local.linear() * network.T_local_scan[level.scan].linear().col(2);
  y.segment<2>(part.row) = up.cross(Eigen::Vector3d::UnitZ()).head<2>();
  A.block<2, 2>(part.row, 0).diagonal().setConstant(1 / frame_.radius_m);
  part.by_scan.leftCols<3>() = T_survey_local.linear().topRows<2>() / network.frames[level.scan].radius_m;
  R.block<2, 2>(part.row, part.row).diagonal().setConstant(level.sigma_rad * level.sigma_rad);
}

void SurveyEquations::factorize(const ScanNetwork& network) {
  BC = Eigen::MatrixXd::Zero(num_rows(), network.covariance_m2.cols());
  for (const Part& part : parts_) {
    if (part.scan == kNoScan) continue;
    BC.middleRows(part.row, part.rows) =
        part.by_scan * network.covariance_m2.middleRows<6>(static_cast<Eigen::Index>(6 * part.scan));
  }
  Eigen::MatrixXd total = R;
  for (const Part& part : parts_) {
    if (part.scan == kNoScan) continue;
    total.middleCols(part.row, part.rows) +=
        BC.middleCols<6>(static_cast<Eigen::Index>(6 * part.scan)) * part.by_scan.transpose();
  }
  S.compute((total + total.transpose()) / 2);
}

}  // namespace tcm_icp
