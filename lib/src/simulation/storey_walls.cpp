// Walls, doors and windows of a storey.

#include <algorithm>
#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/storey.hpp"
#include "simulation/town_objects.hpp"

namespace tcm_icp {
namespace {

constexpr double kDoorHeight_m = 2.05;

}  // namespace

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

void Storey::divide(double side) {
  const double near = half_corridor_m_ + kWall_m;
  const double far = near + uniform(rng_, 4, 6.5);
  for (double x = 0; x < length_m_;) {
    double end = x + uniform(rng_, 3.2, 7);
    if (length_m_ - end < 3.2) end = length_m_;
    Room room{side, x, end, near, far, 0};
    room.door_m = uniform(rng_, x + 0.9, end - 0.9);
    rooms_.push_back(room);
    x = end;
  }
}

void Storey::wall(const Eigen::AlignedBox3d& b) { add_box(scene_.mesh, Isometry3d::Identity(), b, kPlaster); }

void Storey::wall(double side, double x0, double x1, double near, double far, double z0, double z1) {
  const double a = side * near, b = side * far;
  wall(box(x0, x1, std::min(a, b), std::max(a, b), z0, z1));
}

void Storey::build_shell(bool is_closed) {
  const double y = 9;
  for (const double z : {0.0, height_m_})
    add_quad(scene_.mesh, {-0.2, -y, z}, {length_m_ + 0.2, -y, z}, {length_m_ + 0.2, y, z}, {-0.2, y, z},
             z == 0 ? 0.4 : kPlaster);
  for (const double x : {-kWall_m, length_m_}) {
    if (x < 0 || is_closed)
      wall(box(x, x + kWall_m, -y, y, 0, height_m_));
    else
      for (const double side : {-1.0, 1.0}) wall(side, x, x + kWall_m, half_corridor_m_, y, 0, height_m_);
  }
  for (double x = uniform(rng_, 1, 2); x < length_m_; x += uniform(rng_, 2.6, 3.4))
    wall(box(x, x + 1.2, -0.1, 0.1, height_m_ - 0.12, height_m_ - 0.04));
}

void Storey::build_walls(const Room& room) {
  const double near = room.near_m - kWall_m, left = room.door_m - kDoorWidth_m / 2, right = left + kDoorWidth_m;
  wall(room.side, room.begin_m, left, near, room.near_m, 0, height_m_);
  wall(room.side, right, room.end_m, near, room.near_m, 0, height_m_);
  wall(room.side, left, right, near, room.near_m, kDoorHeight_m, height_m_);
  wall(room.side, room.end_m - kWall_m / 2, room.end_m + kWall_m / 2, room.near_m, room.far_m, 0, height_m_);
  // The door stands open, nearly against the wall of its room.
  const double open = uniform(contents_, 1.8, 2.7);
  const Isometry3d T_world_hinge = upright_pose({left, room.side * room.near_m, 0}, room.side * open);
  add_box(scene_.mesh, T_world_hinge, box(0, kDoorWidth_m - 0.03, -0.02, 0.02, 0.01, kDoorHeight_m), 0.6);
  const Vector2d middle = (T_world_hinge * Vector3d(kDoorWidth_m / 2, 0, 0)).head<2>();
  plan_.take({middle, room.side * open, {kDoorWidth_m / 2, 0.1}});
  plan_.take({{room.door_m, room.side * (room.near_m + 0.45)}, 0, {kDoorWidth_m / 2, 0.45}});
}

void Storey::build_windows(const Room& room) {
  const double width = room.end_m - room.begin_m;
  const int count = 1 + static_cast<int>(width / uniform(rng_, 2.2, 4));
  const double sill = uniform(rng_, 0.75, 1.1);
  const double half = 0.5 * width / count * uniform(rng_, 0.45, 0.8);
  const Isometry3d T_world_wall = room.side > 0 ? upright_pose({room.begin_m, room.far_m, 0}, 0)
                                                : upright_pose({room.end_m, -room.far_m, 0}, std::numbers::pi);
  for (int i = 0; i < count; ++i) {
    const double x0 = width * i / count, x1 = width * (i + 1) / count, middle = (x0 + x1) / 2;
    const Panel panel{AlignedBox2d(Vector2d(x0, 0), Vector2d(x1, height_m_)),
                      AlignedBox2d(Vector2d(middle - half, sill), Vector2d(middle + half, height_m_ - 0.3)), 0.18};
    add_panel(scene_.mesh, T_world_wall, panel, kPlaster, 0.05);
    add_box(scene_.mesh, T_world_wall, box(middle - 0.8 * half, middle + 0.8 * half, -0.12, -0.03, 0.12, 0.65), 0.6);
  }
}

}  // namespace tcm_icp
