#pragma once
// A building that is its own mirror image.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// Two equal wings with pavilions, a portico of columns under a pediment, and a dome. The front faces -y; the origin is
/// on the ground in the middle of the front. x -> -x maps it onto itself.
void add_palace(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_palace, double half_width_m, Rng& rng);

}  // namespace tcm_icp
