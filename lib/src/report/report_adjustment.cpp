#include <numbers>

#include "report_parts.hpp"

namespace tcm_icp {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

Json to_json(const LinkAxis& axis) {
  return {{"slide_m", number(axis.slide_m)},
          {"slide_translation_m", vector(axis.slide_m * axis.translation)},
          {"slide_rotation_deg", vector(axis.slide_m * kDegrees * axis.rotation_per_m)},
          {"sigma_m", number(axis.sigma_m)}};
}

}  // namespace

Json to_json(const LpFigures& lp) {
  return {{"programs", lp.num_programs},
          {"pivots", lp.num_pivots},
          {"last_objective_m", number(lp.objective)},
          {"largest_relative_duality_gap", number(lp.relative_duality_gap)},
          {"seconds", lp.seconds}};
}

Json adjustment_json(const PipelineResult& result) {
  const AdjustmentRecord& a = result.adjustment;
  const JointUncertainty& u = result.uncertainty;
  Json outlying = Json::array();
  for (const auto& [first, second] : a.outlying_pairs) {
    outlying.push_back({result.scans[first].file, result.scans[second].file});
  }
  return {{"lp", to_json(a.lp)},
          {"lp_status", to_string(a.lp_status)},
          {"lp_matches", a.num_lp_matches},
          {"lp_rms_move_m", a.lp_rms_move_m},
          {"steps", a.num_steps},
          {"rms_move_m", a.rms_move_m},
          {"bending_m", a.bending_m},
          {"motion_m", a.motion_m},
          {"outlying_links", outlying},
          {"noise_m", u.noise_m},
          {"block_m", u.block_m},
          {"correlation_factor", u.correlation_factor},
          {"disagreement_factor", u.disagreement_factor}};
}

Json to_json(const PoseUncertainty& pose, const Eigen::Vector3d& origin) {
  if (!pose.determined) return nullptr;
  return {{"centre_m", vector(pose.centre + origin)},
          {"sigma_position_m", vector(pose.sigma_position_m())},
          {"sigma_rotation_deg", vector(kDegrees * pose.sigma_rotation_rad())},
          {"covariance", to_json(Eigen::MatrixXd(pose.covariance))}};
}

Json to_json(const LinkStrength& strength, const Eigen::Vector3d& origin) {
  Json axes = Json::array();
  for (const auto& axis : strength.axes) axes.push_back(to_json(axis));
  return {{"matches", strength.num_matches},
          {"centre_m", vector(strength.centre + origin)},
          {"radius_m", strength.radius_m},
          {"axes", axes}};
}

}  // namespace tcm_icp
