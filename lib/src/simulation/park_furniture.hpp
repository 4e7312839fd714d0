#pragma once
// What stands in a park or on a square. Frames as in town_objects.hpp.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

void add_picnic_table(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_table, Rng& rng);
void add_bench(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_bench, Rng& rng);
void add_boulder(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_boulder, Rng& rng);
void add_log(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_log, Rng& rng);
void add_fire_ring(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_ring, Rng& rng);

/// A boat that lies on the ground, keel along x.
void add_boat(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_boat, Rng& rng);

/// A deck on posts from the origin along -y, `length_m` long, its top at z = 0.8.
void add_jetty(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_jetty, double length_m);

/// A round basin with a column and a bowl in its middle.
void add_fountain(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_fountain, Rng& rng);

/// A figure on a pedestal.
void add_statue(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_statue, Rng& rng);

}  // namespace tcm_icp
