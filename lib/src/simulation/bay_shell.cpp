// Floors, walls, columns and beams of a building of bays.

#include <numbers>

#include "simulation/bay_plan.hpp"
#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/town_objects.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFloor = 0.4;
constexpr double kBayGlass = 0.05;

void add_sheet(TriangleMesh& mesh, const AlignedBox2d& area, double z, double reflectivity) {
  const Vector2d low = area.min(), high = area.max();
  add_quad(mesh, {low.x(), low.y(), z}, {high.x(), low.y(), z}, {high.x(), high.y(), z}, {low.x(), high.y(), z},
           reflectivity);
}

/// The same with a hole: four sheets around it.
void add_sheet(TriangleMesh& mesh, const AlignedBox2d& area, const AlignedBox2d& hole, double z, double reflectivity) {
  const Vector2d low = area.min(), high = area.max(), from = hole.min(), to = hole.max();
  add_sheet(mesh, {low, Vector2d(from.x(), high.y())}, z, reflectivity);
  add_sheet(mesh, {Vector2d(to.x(), low.y()), high}, z, reflectivity);
  add_sheet(mesh, {Vector2d(from.x(), low.y()), Vector2d(to.x(), from.y())}, z, reflectivity);
  add_sheet(mesh, {Vector2d(from.x(), to.y()), Vector2d(to.x(), high.y())}, z, reflectivity);
}

class Shell {
 public:
  Shell(TriangleMesh& mesh, const BayPlan& plan) : mesh_(mesh), plan_(plan) {}

  void build() {
    for (int storey = 0; storey < plan_.storeys; ++storey) {
      add_slabs(plan_.floor_m(storey), kFloor, storey > 0);
      add_slabs(plan_.ceiling_m(storey), kPlaster, storey + 1 < plan_.storeys);
      if (storey > 0) add_rim(plan_.ceiling_m(storey - 1), plan_.floor_m(storey));
      add_columns(storey);
      add_beams(storey);
      add_walls(storey);
      add_lamps(storey);
    }
  }

 private:
  /// One side of a floor, bay by bay: rays find small triangles sooner than large ones.
  void add_slabs(double z, double reflectivity, bool is_open) {
    for (int i = 0; i < plan_.along; ++i) {
      for (int j = 0; j < plan_.across; ++j) {
        if (is_open && i == plan_.well && j == plan_.core_row())
          add_sheet(mesh_, plan_.bay(i, j), plan_.opening(), z, reflectivity);
        else
          add_sheet(mesh_, plan_.bay(i, j), z, reflectivity);
      }
    }
  }

  /// The edges of a floor's opening.
  void add_rim(double z0, double z1) {
    const Vector2d low = plan_.opening().min(), high = plan_.opening().max();
    for (const double x : {low.x(), high.x()})
      add_quad(mesh_, {x, low.y(), z0}, {x, high.y(), z0}, {x, high.y(), z1}, {x, low.y(), z1}, kConcrete);
    for (const double y : {low.y(), high.y()})
      add_quad(mesh_, {low.x(), y, z0}, {high.x(), y, z0}, {high.x(), y, z1}, {low.x(), y, z1}, kConcrete);
  }

  void add_columns(int storey) {
    const double half = plan_.half_column_m, height = plan_.storey_m - BayPlan::kSlab_m;
    for (int i = 0; i <= plan_.along; ++i) {
      for (int j = 0; j <= plan_.across; ++j) {
        const Isometry3d T_world_foot(Eigen::Translation3d(i * plan_.bay_m, j * plan_.bay_m, plan_.floor_m(storey)));
        if (plan_.has_round_columns)
          add_frustum(mesh_, T_world_foot, {half, half, height, 16}, kConcrete);
        else
          add_box(mesh_, T_world_foot, box(-half, half, -half, half, 0, height), kConcrete);
      }
    }
  }

  void add_beams(int storey) {
    const double z = plan_.ceiling_m(storey);
    for (int i = 0; i <= plan_.along; ++i) {
      for (int j = 0; j <= plan_.across; ++j) {
        const Vector3d column(i * plan_.bay_m, j * plan_.bay_m, z);
        if (i < plan_.along) add_beam(upright_pose(column, 0));
        if (j < plan_.across) add_beam(upright_pose(column, std::numbers::pi / 2));
      }
    }
  }

  /// Along x to the next column: what is seen from below.
  void add_beam(const Isometry3d& T_world_beam) {
    constexpr double kHalf = BayPlan::kHalfBeam_m, kLow = -BayPlan::kBeam_m;
    const auto strip = [&](double y0, double z0, double y1, double z1) {
      const double b = plan_.bay_m;
      add_quad(mesh_, T_world_beam * Vector3d(0, y0, z0), T_world_beam * Vector3d(b, y0, z0),
               T_world_beam * Vector3d(b, y1, z1), T_world_beam * Vector3d(0, y1, z1), kConcrete);
    };
    strip(-kHalf, 0, -kHalf, kLow);
    strip(-kHalf, kLow, kHalf, kLow);
    strip(kHalf, kLow, kHalf, 0);
  }

  void add_walls(int storey) {
    constexpr double kTurn = std::numbers::pi / 2;
    const double b = plan_.bay_m, z = plan_.floor_m(storey);
    for (int i = 0; i < plan_.along; ++i) {
      add_wall(upright_pose({i * b, plan_.width_m(), z}, 0));
      add_wall(upright_pose({(i + 1) * b, 0, z}, 2 * kTurn));
    }
    for (int j = 0; j < plan_.across; ++j) {
      add_wall(upright_pose({plan_.length_m(), (j + 1) * b, z}, -kTurn));
      add_wall(upright_pose({0, j * b, z}, kTurn));
    }
  }

  /// The wall of one bay, with a window and a radiator below it.
  void add_wall(const Isometry3d& T_world_wall) {
    const double middle = plan_.bay_m / 2, half = plan_.half_window_m, height = plan_.storey_m - BayPlan::kSlab_m;
    const Panel panel{AlignedBox2d(Vector2d(0, 0), Vector2d(plan_.bay_m, height)),
                      AlignedBox2d(Vector2d(middle - half, plan_.sill_m), Vector2d(middle + half, height - 0.45)), 0.2};
    add_panel(mesh_, T_world_wall, panel, kPlaster, kBayGlass);
    add_box(mesh_, T_world_wall, box(middle - 0.6, middle + 0.6, -0.14, -0.04, 0.12, 0.65), 0.6);
  }

  /// Two below each bay's ceiling, but over the stairs.
  void add_lamps(int storey) {
    const double top = plan_.ceiling_m(storey);
    for (int i = 0; i < plan_.along; ++i) {
      for (int j = 0; j < plan_.across; ++j) {
        if (i == plan_.well && j == plan_.core_row()) continue;
        const Vector2d at = plan_.bay(i, j).center();
        for (const double side : {-1.0, 1.0}) {
          const double y = at.y() + side * plan_.bay_m / 4;
          add_box(mesh_, Isometry3d::Identity(),
                  box(at.x() - 0.7, at.x() + 0.7, y - 0.1, y + 0.1, top - 0.12, top - 0.04), kPlaster);
        }
      }
    }
  }

  TriangleMesh& mesh_;
  const BayPlan& plan_;
};

}  // namespace

void add_bays(TriangleMesh& mesh, const BayPlan& plan) { Shell(mesh, plan).build(); }

}  // namespace tcm_icp
