#pragma once
// What stands in halls, in frames like those of room_furniture.hpp: the origin on the floor in the object's middle, x
// along its length.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// A few, on and beside one another.
void add_crates(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_crates, Rng& rng);

/// A body on a base, a drum on it and a panel beside it.
void add_machine(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_machine, Rng& rng);

/// A rack with loads on some of its places.
void add_rack(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_rack, Rng& rng);

}  // namespace tcm_icp
