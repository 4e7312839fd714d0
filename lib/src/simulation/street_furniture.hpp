#pragma once
// What stands about in a street, beside the objects of a town. Frames as in town_objects.hpp.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

void add_van(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_van, Rng& rng);

/// A pole with one or two plates.
void add_sign(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_sign, Rng& rng);
void add_bollard(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_bollard, Rng& rng);

/// A box of any size a bin, a letter box or a switch cabinet has.
void add_cabinet(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_cabinet, Rng& rng);

/// A column for posters.
void add_poster_column(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_column, Rng& rng);

/// A roof on posts with a back, for who waits for a bus; open to -y.
void add_shelter(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_shelter, Rng& rng);

/// A wall or a hedge along x, `length_m` long.
void add_garden_wall(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_wall, double length_m, Rng& rng);
void add_hedge(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_hedge, double length_m, Rng& rng);

}  // namespace tcm_icp
