#include "simulation/town_objects.hpp"

#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A car's cabin: a box with sloping front and back.
void add_cabin(TriangleMesh& mesh, const Isometry3d& T, double half_width, double bottom, double top) {
  const auto at = [&](double x, double y, double z) -> Vector3d { return T * Vector3d(x, y, z); };
  const double inner = half_width - 0.15;
  add_quad(mesh, at(0.9, -half_width, bottom), at(0.9, half_width, bottom), at(0.2, inner, top), at(0.2, -inner, top),
           0.15);
  add_quad(mesh, at(-1.9, -half_width, bottom), at(-1.9, half_width, bottom), at(-1.5, inner, top),
           at(-1.5, -inner, top), 0.15);
  add_quad(mesh, at(0.2, -inner, top), at(0.2, inner, top), at(-1.5, inner, top), at(-1.5, -inner, top), 0.5);
  for (const double side : {-1.0, 1.0}) {
    add_quad(mesh, at(0.9, side * half_width, bottom), at(-1.9, side * half_width, bottom), at(-1.5, side * inner, top),
             at(0.2, side * inner, top), 0.15);
  }
}

}  // namespace

void add_shed(TriangleMesh& mesh, const Isometry3d& T_world_shed, const Vector2d& half_size_m, Rng& rng) {
  const double x = half_size_m.x(), y = half_size_m.y();
  const double height = uniform(rng, 2.3, 3.2);
  add_box(mesh, T_world_shed, box(-x, x, -y, y, -kObjectFooting_m, height), 0.45);
  add_box(mesh, T_world_shed, box(-x - 0.25, x + 0.25, -y - 0.25, y + 0.25, height, height + 0.2), 0.4);
  // The door's frame stands out by 6 cm.
  const Isometry3d T_world_front = T_world_shed * Translation3d(0, -y - 0.06, 0);
  const Panel door{AlignedBox2d(Vector2d(-1.4, 0), Vector2d(1.4, 2.2)),
                   AlignedBox2d(Vector2d(-1.25, 0), Vector2d(1.25, 2.05)), 0.03};
  add_panel(mesh, T_world_front, door, 0.5, 0.4);
}

void add_tree(TriangleMesh& mesh, const Isometry3d& T_world_tree, Rng& rng) {
  const double trunk_height = uniform(rng, 2.2, 4.5);
  const double trunk_radius = uniform(rng, 0.1, 0.28);
  const double crown_radius = uniform(rng, 1.2, 2.4);
  const double crown_half_height = uniform(rng, 1.2, 2.6);
  add_frustum(mesh, T_world_tree * Translation3d(0, 0, -kObjectFooting_m),
              {trunk_radius, 0.6 * trunk_radius, kObjectFooting_m + trunk_height + 0.5 * crown_half_height, 10}, 0.35);
  // Leaves in proportion to the crown's surface, so that small and large crowns let through the same share of light.
  const int leaves = static_cast<int>(110 * crown_radius * (crown_radius + crown_half_height));
  add_foliage(mesh, T_world_tree * Translation3d(0, 0, trunk_height + 0.7 * crown_half_height),
              {Vector3d(crown_radius, 0.9 * crown_radius, crown_half_height), leaves, 0.25}, 0.4, rng);
}

void add_bush(TriangleMesh& mesh, const Isometry3d& T_world_bush, Rng& rng) {
  const double radius = uniform(rng, 0.4, 0.9);
  const double height = uniform(rng, 0.5, 1.2);
  add_foliage(mesh, T_world_bush * Translation3d(0, 0, 0.45 * height),
              {Vector3d(radius, 0.8 * radius, 0.6 * height), static_cast<int>(400 * radius), 0.15}, 0.4, rng);
}

void add_car(TriangleMesh& mesh, const Isometry3d& T_world_car, Rng& rng) {
  const double half_width = uniform(rng, 0.82, 0.95);
  const double half_length = uniform(rng, 1.9, 2.4);
  const double height = uniform(rng, 1.4, 1.75);
  add_box(mesh, T_world_car, box(-half_length, half_length, -half_width, half_width, 0.25, 0.85), 0.5);
  add_cabin(mesh, T_world_car, half_width - 0.05, 0.85, height);
  for (const double x : {-1.3, 1.3}) {
    for (const double side : {-1.0, 1.0}) {
      const Isometry3d T_world_wheel = T_world_car * Translation3d(x, side * (half_width - 0.2), 0.32) *
                                       Eigen::AngleAxisd(-side * std::numbers::pi / 2, Vector3d::UnitX());
      add_frustum(mesh, T_world_wheel, {0.32, 0.32, 0.22, 14}, 0.1);
    }
  }
}

void add_lamp(TriangleMesh& mesh, const Isometry3d& T_world_lamp, Rng& rng) {
  const double height = uniform(rng, 4.5, 7);
  add_frustum(mesh, T_world_lamp * Translation3d(0, 0, -kObjectFooting_m), {0.1, 0.06, kObjectFooting_m + height, 10},
              0.5);
  add_box(mesh, T_world_lamp, box(-0.05, 1.6, -0.05, 0.05, height - 0.1, height), 0.5);
  add_box(mesh, T_world_lamp, box(1.1, 1.8, -0.15, 0.15, height - 0.2, height - 0.1), 0.5);
}

void add_fence(TriangleMesh& mesh, const Isometry3d& T_world_fence, double length_m) {
  const int spans = std::max(1, static_cast<int>(length_m / 2));
  for (int i = 0; i <= spans; ++i) {
    const double x = length_m * (static_cast<double>(i) / spans - 0.5);
    add_box(mesh, T_world_fence, box(x - 0.06, x + 0.06, -0.06, 0.06, -kObjectFooting_m, 1.2), 0.4);
  }
  for (const double z : {0.45, 1.0}) {
    add_box(mesh, T_world_fence, box(-length_m / 2, length_m / 2, -0.02, 0.02, z, z + 0.14), 0.4);
  }
}

}  // namespace tcm_icp
