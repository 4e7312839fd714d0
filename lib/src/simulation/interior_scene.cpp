// One storey of a building: a corridor, rooms, furniture.

#include <algorithm>
#include <numbers>
#include <string>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/room_furniture.hpp"
#include "simulation/site_plan.hpp"
#include "simulation/town_objects.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWall_m = 0.12;
constexpr double kPlaster = 0.7;
constexpr double kDoorWidth_m = 0.95;
constexpr double kDoorHeight_m = 2.05;

/// A room beside the corridor. `side` is -1 or 1; y runs from the corridor's wall to the outer one.
struct Room {
  double side = 1;
  double begin_m = 0, end_m = 0;  ///< along x
  double near_m = 0, far_m = 0;   ///< distance of both walls from the corridor's middle
  double door_m = 0;              ///< middle of the door, along x

  Vector3d centre() const { return {(begin_m + end_m) / 2, side * (near_m + far_m) / 2, 0}; }
};

class Storey {
 public:
  Storey(const InteriorOptions& options, Rng& rng)
      : length_m_(options.length_m),
        rng_(rng),
        height_m_(uniform(rng, 2.6, 3.1)),
        half_corridor_m_(uniform(rng, 0.9, 1.3)) {}

  Scene build() {
    for (const double side : {-1.0, 1.0}) divide(side);
    lay_path();
    build_shell();
    for (const Room& room : rooms_) {
      build_walls(room);
      build_windows(room);
      furnish(room);
    }
    furnish_corridor();
    scene_.free_half_width_m = 0.25;
    return std::move(scene_);
  }

 private:
  void wall(const Eigen::AlignedBox3d& b) { add_box(scene_.mesh, Isometry3d::Identity(), b, kPlaster); }
  /// A box whose y is counted from the corridor's middle towards `side`.
  void wall(double side, double x0, double x1, double near, double far, double z0, double z1) {
    const double a = side * near, b = side * far;
    wall(box(x0, x1, std::min(a, b), std::max(a, b), z0, z1));
  }

  void divide(double side) {
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

  /// From the first room on one side into the corridor, into a room half way, and into the last room on the other side.
  void lay_path() {
    const auto first = std::find_if(rooms_.begin(), rooms_.end(), [](const Room& r) { return r.side > 0; });
    const auto half_way = std::find_if(first, rooms_.end(), [&](const Room& r) { return r.end_m > 0.55 * length_m_; });
    const Room& last = *(first - 1);
    const auto before_door = [](const Room& r) -> Vector3d { return {r.door_m, r.side * (r.near_m + 0.9), 0}; };
    const auto at_door = [](const Room& r) -> Vector3d { return {r.door_m, 0, 0}; };
    scene_.path = {first->centre(), before_door(*first), at_door(*first)};
    if (half_way->begin_m > first->begin_m)
      for (const Vector3d& p : {at_door(*half_way), half_way->centre(), before_door(*half_way), at_door(*half_way)})
        scene_.path.push_back(p);
    for (const Vector3d& p : {at_door(last), before_door(last), last.centre()}) scene_.path.push_back(p);
    for (double s = 0; s < path_length_m(scene_.path); s += 0.3) {
      const PathPoint here = along_path(scene_.path, s);
      plan_.take({here.position.head<2>(), here.heading_rad, {0.3, 0.6}});
    }
  }

  void build_shell() {
    const double y = 9;
    for (const double z : {0.0, height_m_})
      add_quad(scene_.mesh, {-0.2, -y, z}, {length_m_ + 0.2, -y, z}, {length_m_ + 0.2, y, z}, {-0.2, y, z},
               z == 0 ? 0.4 : kPlaster);
    for (const double x : {-kWall_m, length_m_}) wall(box(x, x + kWall_m, -y, y, 0, height_m_));
    for (double x = uniform(rng_, 1, 2); x < length_m_; x += uniform(rng_, 2.6, 3.4))
      wall(box(x, x + 1.2, -0.1, 0.1, height_m_ - 0.12, height_m_ - 0.04));
  }

  /// The wall to the corridor with its door, and the wall to the next room.
  void build_walls(const Room& room) {
    const double near = room.near_m - kWall_m, left = room.door_m - kDoorWidth_m / 2, right = left + kDoorWidth_m;
    wall(room.side, room.begin_m, left, near, room.near_m, 0, height_m_);
    wall(room.side, right, room.end_m, near, room.near_m, 0, height_m_);
    wall(room.side, left, right, near, room.near_m, kDoorHeight_m, height_m_);
    wall(room.side, room.end_m - kWall_m / 2, room.end_m + kWall_m / 2, room.near_m, room.far_m, 0, height_m_);
    // The door stands open, nearly against the wall of its room.
    const double open = uniform(rng_, 1.8, 2.7);
    const Isometry3d T_world_hinge = upright_pose({left, room.side * room.near_m, 0}, room.side * open);
    add_box(scene_.mesh, T_world_hinge, box(0, kDoorWidth_m - 0.03, -0.02, 0.02, 0.01, kDoorHeight_m), 0.6);
    const Vector2d middle = (T_world_hinge * Vector3d(kDoorWidth_m / 2, 0, 0)).head<2>();
    plan_.take({middle, room.side * open, {kDoorWidth_m / 2, 0.1}});
    plan_.take({{room.door_m, room.side * (room.near_m + 0.45)}, 0, {kDoorWidth_m / 2, 0.45}});
  }

  void build_windows(const Room& room) {
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

  using Add = void (*)(TriangleMesh&, const Isometry3d&, Rng&);

  /// With its back (+y) to one of the walls.
  void put_at_wall(const Room& room, Add add, const Vector2d& half_size) {
    const double heading = std::numbers::pi / 2 * static_cast<double>(uniform_index(rng_, 4));
    const Vector2d back(-std::sin(heading), std::cos(heading));
    const Vector2d middle = room.centre().head<2>();
    const Vector2d half_room((room.end_m - room.begin_m - kWall_m) / 2, (room.far_m - room.near_m) / 2 - 0.02);
    const double slide = uniform(rng_, -1, 1);
    Vector2d at;
    for (int axis = 0; axis < 2; ++axis) {
      const bool is_back = std::abs(back[axis]) > 0.5;
      at[axis] = middle[axis] + (is_back ? std::round(back[axis]) * (half_room[axis] - half_size.y())
                                         : slide * std::max(0.0, half_room[axis] - half_size.x()));
    }
    put({at, heading, half_size}, add);
  }

  void put_anywhere(const Room& room, Add add, const Vector2d& half_size) {
    const double reach = half_size.maxCoeff() + 0.1;
    const double x = uniform(rng_, room.begin_m + reach, room.end_m - reach);
    const double y = uniform(rng_, room.near_m + reach, room.far_m - reach);
    const double heading =
        std::numbers::pi / 2 * static_cast<double>(uniform_index(rng_, 4)) + uniform(rng_, -0.2, 0.2);
    if (room.end_m - room.begin_m < 2 * reach || room.far_m - room.near_m < 2 * reach) return;
    put({{x, room.side * y}, heading, half_size}, add);
  }

  void put(const Footprint& spot, Add add) {
    if (!plan_.is_free(spot, 0.02)) return;
    plan_.take(spot);
    add(scene_.mesh, upright_pose({spot.centre.x(), spot.centre.y(), 0}, spot.heading_rad), rng_);
  }

  void furnish(const Room& room) {
    const double area = (room.end_m - room.begin_m) * (room.far_m - room.near_m);
    const double purpose = uniform01(rng_);  // office, meeting room or lounge
    const int pieces = static_cast<int>(area / 3);
    if (purpose > 0.55 && purpose < 0.8) put_anywhere(room, add_meeting_table, {1.6, 1.1});
    for (int i = 0; i < pieces; ++i) {
      const double kind = uniform01(rng_);
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

  void furnish_corridor() {
    for (int i = 0; i < static_cast<int>(length_m_ / 3); ++i) {
      const double x = uniform(rng_, 0.5, length_m_ - 0.5);
      const double side = uniform01(rng_) < 0.5 ? -1 : 1;
      const double half = uniform(rng_, 0.1, 0.5);
      const double top = uniform(rng_, 0.5, 2);
      const double depth = uniform(rng_, 0.06, 0.2);
      const Footprint spot{{x, side * (half_corridor_m_ - depth / 2)}, 0, {half, depth / 2}};
      const bool blocks_door = std::any_of(rooms_.begin(), rooms_.end(), [&](const Room& r) {
        return r.side == side && std::abs(r.door_m - x) < kDoorWidth_m / 2 + half;
      });
      if (blocks_door || !plan_.is_free(spot, 0)) continue;
      plan_.take(spot);
      wall(side, x - half, x + half, half_corridor_m_ - depth, half_corridor_m_, top > 1.2 ? 1.1 : 0, top);
    }
  }

  const double length_m_;
  Rng& rng_;
  const double height_m_, half_corridor_m_;
  std::vector<Room> rooms_;
  SitePlan plan_;
  Scene scene_;
};

}  // namespace

void InteriorOptions::validate() const {
  if (!(length_m >= 15 && length_m <= 500))
    throw InvalidOptions("interior: length_m = " + std::to_string(length_m) + "; needs 15..500");
}

Scene make_interior_scene(const InteriorOptions& options, Rng& rng) {
  options.validate();
  return Storey(options, rng).build();
}

}  // namespace tcm_icp
