#pragma once
// What stands in a town. Every object's frame has its origin on the ground in the object's middle, x along its length.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

struct House {
  Eigen::Vector2d half_size_m{6, 4};  ///< of the walls; the roof reaches 0.4 m over them
  int num_storeys = 2;
  double storey_height_m = 2.9;
  double roof_rise_m = 2.5;
  double window_width_m = 1.1;
  double cell_width_m = 2.6;  ///< from window to window
  double reflectivity = 0.6;
};

/// Walls with recessed windows (some left out), a door, a gabled roof and a chimney.
void add_house(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_house, const House& house, Rng& rng);

/// A panel of the x-z plane that faces -y, from `low` to `high` (x and z) [m], with an opening whose back lies
/// `recess_m` behind it: four strips, four reveals and the back.
struct Panel {
  Eigen::AlignedBox2d outer, opening;
  double recess_m = 0.2;
};
void add_panel(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_wall, const Panel& panel, double reflectivity,
               double back_reflectivity);

void add_shed(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_shed, const Eigen::Vector2d& half_size_m, Rng& rng);
void add_tree(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_tree, Rng& rng);
void add_bush(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_bush, Rng& rng);
void add_car(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_car, Rng& rng);
void add_lamp(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_lamp, Rng& rng);

/// Posts and two rails along x, `length_m` long.
void add_fence(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_fence, double length_m);

}  // namespace tcm_icp
