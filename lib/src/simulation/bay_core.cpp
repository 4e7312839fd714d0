// Lifts and stairs of a building of bays.

#include <numbers>

#include "simulation/bay_plan.hpp"
#include "simulation/draw.hpp"
#include "simulation/stairs.hpp"
#include "simulation/town_objects.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;

constexpr double kSteel = 0.3;

/// A wall of `width_m` along x that faces -y, with doors of `half_door_m` evenly along it; none where there are 0.
void add_front(TriangleMesh& mesh, const Isometry3d& T_world_wall, const Vector2d& size_m, int num_doors,
               double half_door_m) {
  if (num_doors == 0)
    return add_quad(mesh, T_world_wall.translation(), T_world_wall * Eigen::Vector3d(size_m.x(), 0, 0),
                    T_world_wall * Eigen::Vector3d(size_m.x(), 0, size_m.y()),
                    T_world_wall * Eigen::Vector3d(0, 0, size_m.y()), kPlaster);
  const double width = size_m.x() / num_doors;
  for (int i = 0; i < num_doors; ++i) {
    const double middle = (i + 0.5) * width;
    const Panel panel{AlignedBox2d(Vector2d(i * width, 0), Vector2d((i + 1) * width, size_m.y())),
                      AlignedBox2d(Vector2d(middle - half_door_m, 0), Vector2d(middle + half_door_m, 2.1)), 0.2};
    add_panel(mesh, T_world_wall, panel, kPlaster, kSteel);
  }
}

/// Walls around the bay of the lifts: their doors to one aisle, one door to the other.
void add_lifts(TriangleMesh& mesh, const BayPlan& plan, int storey) {
  constexpr double kTurn = std::numbers::pi / 2;
  const AlignedBox2d b = plan.bay(plan.well + 1, plan.core_row());
  const Vector2d low = b.min(), high = b.max(), size(plan.bay_m, plan.storey_m - BayPlan::kSlab_m);
  const double z = plan.floor_m(storey);
  add_front(mesh, upright_pose({low.x(), low.y(), z}, 0), size, 2, 0.55);
  add_front(mesh, upright_pose({high.x(), high.y(), z}, 2 * kTurn), size, 1, 0.48);
  add_front(mesh, upright_pose({high.x(), low.y(), z}, kTurn), size, 0, 0);
  add_front(mesh, upright_pose({low.x(), high.y(), z}, -kTurn), size, 0, 0);
}

}  // namespace

void add_bay_core(TriangleMesh& mesh, const BayPlan& plan) {
  for (int storey = 0; storey < plan.storeys; ++storey) add_lifts(mesh, plan, storey);
  const Stairs stairs(plan.opening(), plan.storey_m);
  for (int storey = 1; storey < plan.storeys; ++storey) {
    stairs.add_to(mesh, plan.floor_m(storey - 1));
    stairs.guard(mesh, plan.floor_m(storey));
  }
}

}  // namespace tcm_icp
