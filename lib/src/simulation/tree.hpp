#pragma once
// Trees with branches. Frames as in town_objects.hpp.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// A trunk that divides into branches and these into twigs, with leaves about the twigs' ends.
void add_broadleaf_tree(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_tree, Rng& rng);

/// A straight trunk, bare below, with whorls of branches that grow shorter towards the top and carry tufts of needles.
void add_pine(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_tree, Rng& rng);

}  // namespace tcm_icp
