#include "pipeline/pose_graph_edges.hpp"

#include <cmath>

#include "core/cross_matrix.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

}  // namespace

std::optional<Matrix6> edge_information(const LinkStrength& strength, const Eigen::Isometry3d& T_common_to) {
  // Of motions of the second scan about the link's centre: (rotation by its arc, translation), both [m].
  Matrix6 about_centre = Matrix6::Zero();
  bool is_known = false;
  for (const LinkAxis& axis : strength.axes) {
    if (!std::isfinite(axis.sigma_m) || axis.sigma_m <= 0) continue;
    Twist direction;
    direction << strength.radius_m * axis.rotation_per_m, axis.translation;
    about_centre += direction * direction.transpose() / (axis.sigma_m * axis.sigma_m);
    is_known = true;
  }
  if (!is_known) return std::nullopt;
  // From (d, v) in the scan's own frame: its rotation vector is 2 R v, and its origin p moves by R d, so the centre
  // c moves by t = R d - (2 R v) x (p - c).
  const Eigen::Matrix3d R = T_common_to.linear();
  Matrix6 motion;
  motion << Eigen::Matrix3d::Zero(), 2 * strength.radius_m * R, R,
      2 * cross_matrix(T_common_to.translation() - strength.centre) * R;
  const Matrix6 information = motion.transpose() * about_centre * motion;
  return (information + information.transpose()) / 2;
}

std::vector<PoseGraphEdge> pose_graph_edges(const PipelineResult& result) {
  const auto is_registered = [&](std::size_t i) { return result.poses[i].status != ScanStatus::kUnregistered; };
  std::vector<PoseGraphEdge> edges;
  for (const LinkRecord& link : result.links) {
    if (link.verdict != Verdict::kAccepted || !is_registered(link.a) || !is_registered(link.b)) continue;
    PoseGraphEdge edge{link.a, link.b};
    if (link.strength) {
      Eigen::Isometry3d T_local_to = result.poses[link.b].T_reference_scan;
      T_local_to.pretranslate(-result.local_origin());
      if (const auto information = edge_information(*link.strength, T_local_to)) edge.information = *information;
    }
    edges.push_back(edge);
  }
  return edges;
}

}  // namespace tcm_icp
