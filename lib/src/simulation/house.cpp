#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/draw.hpp"
#include "simulation/town_objects.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHouseFooting_m = 1;  // walls go on below the ground, which is not level
constexpr double kGlass = 0.06;
constexpr double kRoofOverhang_m = 0.4;

/// A wall of `width_m` from the origin of its frame along x, facing -y.
void add_wall(TriangleMesh& mesh, const Isometry3d& T_world_wall, const House& house, double width_m, bool has_door,
              Rng& rng) {
  const auto quad = [&](double x0, double x1, double z0, double z1) {
    add_quad(mesh, T_world_wall * Vector3d(x0, 0, z0), T_world_wall * Vector3d(x1, 0, z0),
             T_world_wall * Vector3d(x1, 0, z1), T_world_wall * Vector3d(x0, 0, z1), house.reflectivity);
  };
  quad(0, width_m, -kHouseFooting_m, 0);
  const int columns = std::max(1, static_cast<int>(width_m / house.cell_width_m));
  const double cell = width_m / columns;
  const int door_column = static_cast<int>(uniform_index(rng, static_cast<std::uint64_t>(columns)));
  for (int storey = 0; storey < house.num_storeys; ++storey) {
    for (int column = 0; column < columns; ++column) {
      const double x = column * cell, z = storey * house.storey_height_m, middle = x + cell / 2;
      const bool blank = uniform01(rng) < 0.2;
      Panel panel{AlignedBox2d(Vector2d(x, z), Vector2d(x + cell, z + house.storey_height_m)), {}, 0.2};
      if (has_door && storey == 0 && column == door_column) {
        panel.opening = AlignedBox2d(Vector2d(middle - 0.5, z + 0.05), Vector2d(middle + 0.5, z + 2.15));
        add_panel(mesh, T_world_wall, panel, house.reflectivity, 0.3);
      } else if (blank) {
        quad(x, x + cell, z, z + house.storey_height_m);
      } else {
        const double half = house.window_width_m / 2;
        panel.opening = AlignedBox2d(Vector2d(middle - half, z + 0.9), Vector2d(middle + half, z + 2.3));
        add_panel(mesh, T_world_wall, panel, house.reflectivity, kGlass);
      }
    }
  }
}

void add_roof(TriangleMesh& mesh, const Isometry3d& T_world_house, const House& house, Rng& rng) {
  const double x = house.half_size_m.x(), y = house.half_size_m.y();
  const double eaves = house.num_storeys * house.storey_height_m, ridge = eaves + house.roof_rise_m;
  const double slope = house.roof_rise_m / y;
  const auto at = [&](double px, double py, double pz) -> Vector3d { return T_world_house * Vector3d(px, py, pz); };
  for (const double side : {-1.0, 1.0}) {
    const double edge_y = side * (y + kRoofOverhang_m), edge_z = eaves - slope * kRoofOverhang_m;
    const double edge_x = x + kRoofOverhang_m;
    add_quad(mesh, at(-edge_x, edge_y, edge_z), at(edge_x, edge_y, edge_z), at(edge_x, 0, ridge), at(-edge_x, 0, ridge),
             0.35);
    mesh.triangles.push_back(
        {at(side * x, -y, eaves), at(side * x, y, eaves), at(side * x, 0, ridge), house.reflectivity});
  }
  const double chimney_x = uniform(rng, -0.6, 0.6) * x;
  const double chimney_y = uniform(rng, -0.4, 0.4) * y;
  add_box(mesh, T_world_house,
          AlignedBox3d(Vector3d(chimney_x - 0.3, chimney_y - 0.3, eaves),
                       Vector3d(chimney_x + 0.3, chimney_y + 0.3, ridge + 0.7)),
          0.4);
}

}  // namespace

void add_panel(TriangleMesh& mesh, const Isometry3d& T_world_wall, const Panel& panel, double reflectivity,
               double back_reflectivity) {
  using Box = AlignedBox2d;
  constexpr Box::CornerType kAround[] = {Box::BottomLeft, Box::BottomRight, Box::TopRight, Box::TopLeft};
  const auto at = [&](const Box& box, int corner, double depth) -> Vector3d {
    const Vector2d p = box.corner(kAround[corner % 4]);
    return T_world_wall * Vector3d(p.x(), depth, p.y());
  };
  for (int i = 0; i < 4; ++i) {
    add_quad(mesh, at(panel.outer, i, 0), at(panel.outer, i + 1, 0), at(panel.opening, i + 1, 0),
             at(panel.opening, i, 0), reflectivity);
    add_quad(mesh, at(panel.opening, i, 0), at(panel.opening, i + 1, 0), at(panel.opening, i + 1, panel.recess_m),
             at(panel.opening, i, panel.recess_m), reflectivity);
  }
  add_quad(mesh, at(panel.opening, 0, panel.recess_m), at(panel.opening, 1, panel.recess_m),
           at(panel.opening, 2, panel.recess_m), at(panel.opening, 3, panel.recess_m), back_reflectivity);
}

void add_house(TriangleMesh& mesh, const Isometry3d& T_world_house, const House& house, Rng& rng) {
  const double x = house.half_size_m.x(), y = house.half_size_m.y();
  // Counter-clockwise, so that each wall's -y faces out.
  const Vector3d corners[] = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  for (int side = 0; side < 4; ++side) {
    const Isometry3d T_world_wall = T_world_house * upright_pose(corners[side], side * std::numbers::pi / 2);
    add_wall(mesh, T_world_wall, house, side % 2 == 0 ? 2 * x : 2 * y, side % 2 == 0, rng);
  }
  add_roof(mesh, T_world_house, house, rng);
}

}  // namespace tcm_icp
