#pragma once
// What stands in rooms. Each frame has its origin on the floor in the object's middle, x along its length; what stands
// against a wall has it at +y.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// With a screen, a drawer unit and what lies about.
void add_desk(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_desk, Rng& rng);
void add_chair(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_chair, Rng& rng);

/// A table with chairs along both sides.
void add_meeting_table(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_table, Rng& rng);

/// Open shelves with books of all sizes.
void add_shelf(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_shelf, Rng& rng);
void add_cupboard(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_cupboard, Rng& rng);
void add_sofa(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_sofa, Rng& rng);
void add_potted_plant(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_plant, Rng& rng);

}  // namespace tcm_icp
