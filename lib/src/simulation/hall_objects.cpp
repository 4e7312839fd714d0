#include "simulation/hall_objects.hpp"

#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"

namespace tcm_icp {

using Eigen::Isometry3d;
using Eigen::Translation3d;

void add_crates(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  for (const double side : {-1.0, 1.0}) {
    double z = 0;
    const int count = static_cast<int>(uniform_index(rng, 3)) + (side > 0 ? 1 : 0);
    for (int i = 0; i < count; ++i) {
      const double x = uniform(rng, 0.25, 0.42);
      const double y = uniform(rng, 0.2, 0.4);
      const double height = uniform(rng, 0.3, 0.7);
      const double turn = uniform(rng, -0.2, 0.2);
      const double reflectivity = uniform(rng, 0.3, 0.6);
      add_box(mesh, T * upright_pose({side * 0.5, 0, z}, turn), box(-x, x, -y, y, 0, height), reflectivity);
      z += height;
    }
  }
}

void add_machine(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.6, 1.1);
  const double y = uniform(rng, 0.35, 0.6);
  const double body = uniform(rng, 0.6, 1.1);
  const double end = uniform(rng, -0.3, 0.6) * x;
  add_box(mesh, T, box(-x, x, -y, y, 0, 0.15), 0.3);
  add_box(mesh, T, box(-x + 0.08, end, -y + 0.06, y - 0.06, 0.15, body), 0.45);
  const double radius = uniform(rng, 0.15, 0.3);
  const Isometry3d T_world_drum =
      T * Translation3d(end, 0, body - radius) * Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY());
  add_frustum(mesh, T_world_drum, {radius, radius, x - end, 16}, 0.4);
  const double panel = uniform(rng, 1.2, 1.7);
  add_box(mesh, T, box(x - 0.15, x - 0.05, -y + 0.05, -y + 0.45, 0.15, panel), 0.5);
}

void add_rack(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double height = uniform(rng, 1.7, 2.4);
  for (const double x : {-1.3, 0.0, 1.3})
    for (const double y : {-0.45, 0.45}) add_box(mesh, T, box(x - 0.04, x + 0.04, y - 0.04, y + 0.04, 0, height), 0.35);
  for (double z = 0.1; z < height - 0.3; z += 0.75) {
    add_box(mesh, T, box(-1.3, 1.3, -0.45, 0.45, z, z + 0.06), 0.4);
    for (const double x : {-0.98, -0.33, 0.33, 0.98}) {
      const double half = uniform(rng, 0.15, 0.28);
      const double load = uniform(rng, 0.2, 0.6);
      const double depth = uniform(rng, 0.2, 0.4);
      if (uniform01(rng) < 0.65)
        add_box(mesh, T, box(x - half, x + half, -depth, depth, z + 0.06, z + 0.06 + load), 0.5);
    }
  }
}

}  // namespace tcm_icp
