// What stands in the rooms and the corridor of a storey.

#include <algorithm>
#include <numbers>

#include "simulation/draw.hpp"
#include "simulation/room_furniture.hpp"
#include "simulation/storey.hpp"

namespace tcm_icp {

using Eigen::Isometry3d;
using Eigen::Vector2d;

void Storey::put_at_wall(const Room& room, Add add, const Vector2d& half_size) {
  const double heading = std::numbers::pi / 2 * static_cast<double>(uniform_index(contents_, 4));
  const Vector2d back(-std::sin(heading), std::cos(heading));
  const Vector2d middle = room.centre().head<2>();
  const Vector2d half_room((room.end_m - room.begin_m - kWall_m) / 2, (room.far_m - room.near_m) / 2 - 0.02);
  const double slide = uniform(contents_, -1, 1);
  Vector2d at;
  for (int axis = 0; axis < 2; ++axis) {
    const bool is_back = std::abs(back[axis]) > 0.5;
    at[axis] = middle[axis] + (is_back ? std::round(back[axis]) * (half_room[axis] - half_size.y())
                                       : slide * std::max(0.0, half_room[axis] - half_size.x()));
  }
  put({at, heading, half_size}, add);
}

void Storey::put_anywhere(const Room& room, Add add, const Vector2d& half_size) {
  const double reach = half_size.maxCoeff() + 0.1;
  const double x = uniform(contents_, room.begin_m + reach, room.end_m - reach);
  const double y = uniform(contents_, room.near_m + reach, room.far_m - reach);
  const double heading =
      std::numbers::pi / 2 * static_cast<double>(uniform_index(contents_, 4)) + uniform(contents_, -0.2, 0.2);
  if (room.end_m - room.begin_m < 2 * reach || room.far_m - room.near_m < 2 * reach) return;
  put({{x, room.side * y}, heading, half_size}, add);
}

void Storey::put(const Footprint& spot, Add add) {
  if (!plan_.is_free(spot, 0.02)) return;
  plan_.take(spot);
  add(scene_.mesh, upright_pose({spot.centre.x(), spot.centre.y(), 0}, spot.heading_rad), contents_);
}

void Storey::furnish(const Room& room) {
  const double area = (room.end_m - room.begin_m) * (room.far_m - room.near_m);
  const double purpose = uniform01(contents_);  // office, meeting room or lounge
  const int pieces = static_cast<int>(area / 3);
  if (purpose > 0.55 && purpose < 0.8) put_anywhere(room, add_meeting_table, {1.6, 1.1});
  for (int i = 0; i < pieces; ++i) {
    const double kind = uniform01(contents_);
    if (kind < 0.25)
      put_at_wall(room, add_shelf, {1.2, 0.18});
    else if (kind < 0.45)
      put_at_wall(room, add_cupboard, {0.9, 0.32});
    else if (kind < 0.6)
      put_anywhere(room, add_chair, {0.3, 0.3});
    else if (kind < 0.7)
      put_anywhere(room, add_potted_plant, {0.3, 0.3});
    else if (purpose < 0.8)
      put_anywhere(room, add_desk, {0.9, 0.45});
    else
      put_at_wall(room, add_sofa, {1.1, 0.42});
  }
}

void Storey::furnish_corridor() {
  for (int i = 0; i < static_cast<int>(length_m_ / 3); ++i) {
    const double x = uniform(contents_, 0.5, length_m_ - 0.5);
    const double side = uniform01(contents_) < 0.5 ? -1 : 1;
    const double half = uniform(contents_, 0.1, 0.5);
    const double top = uniform(contents_, 0.5, 2);
    const double depth = uniform(contents_, 0.06, 0.2);
    const Footprint spot{{x, side * (half_corridor_m_ - depth / 2)}, 0, {half, depth / 2}};
    const bool blocks_door = std::any_of(rooms_.begin(), rooms_.end(), [&](const Room& r) {
      return r.side == side && std::abs(r.door_m - x) < kDoorWidth_m / 2 + half;
    });
    if (blocks_door || !plan_.is_free(spot, 0)) continue;
    plan_.take(spot);
    wall(side, x - half, x + half, half_corridor_m_ - depth, half_corridor_m_, top > 1.2 ? 1.1 : 0, top);
  }
}

}  // namespace tcm_icp
