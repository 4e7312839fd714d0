#include "tcm_icp/registration/correspondences.hpp"

#include <cmath>

namespace tcm_icp {

Correspondences find_correspondences(const Cloud& source, const Eigen::Isometry3d& T_target_source,
                                     const PyramidLevel& target, const CorrespondenceGate& gate) {
  const double max_squared = gate.max_distance_m * gate.max_distance_m;
  const double min_cosine = std::cos(gate.max_normal_angle_rad);
  Correspondences out;
  out.reserve(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d p = T_target_source * source.points[i];
    const Neighbor q = target.index.nearest_within(p, gate.max_distance_m);
    if (!q.found() || q.squared_distance_m2 > max_squared) continue;
    const Eigen::Vector3d n_source = T_target_source.linear() * source.normals[i];
    const Eigen::Vector3d& n_target = target.cloud.normals[q.index];
    const bool has_source = !n_source.isZero(), has_target = !n_target.isZero();
    if (!has_source && !has_target) continue;
    const double agreement = std::abs(n_source.dot(n_target));
    if (has_source && has_target && agreement < min_cosine) continue;
    out.push_back({p, target.cloud.points[q.index], has_target ? n_target : n_source, agreement});
  }
  return out;
}

}  // namespace tcm_icp
