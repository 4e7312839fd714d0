#pragma once
// Builds one storey of a building: a corridor, rooms on either side, furniture.

#include <Eigen/Geometry>
#include <vector>

#include "simulation/site_plan.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {

/// A room beside the corridor. `side` is -1 or 1; y runs from the corridor's wall to the outer one.
struct Room {
  double side = 1;
  double begin_m = 0, end_m = 0;  ///< along x
  double near_m = 0, far_m = 0;   ///< distance of both walls from the corridor's middle
  double door_m = 0;              ///< middle of the door, along x

  Eigen::Vector3d centre() const { return {(begin_m + end_m) / 2, side * (near_m + far_m) / 2, 0}; }
};

class Storey {
 public:
  static constexpr double kWall_m = 0.12;

  /// `plan` draws walls, doors and windows, `contents` what stands between them: storeys alike share the former.
  Storey(double length_m, Rng& plan, Rng& contents);

  double height_m() const { return height_m_; }
  double half_corridor_m() const { return half_corridor_m_; }

  /// A storey alone.
  Scene build();

  /// Without the wall at the far end of the corridor, where stairs join it to others. The path leads from a room
  /// through another to that end.
  Scene build_before_stairs();

 private:
  static constexpr double kDoorWidth_m = 0.95;

  // storey_walls.cpp
  void divide(double side);
  void wall(const Eigen::AlignedBox3d& b);
  /// A box whose y is counted from the corridor's middle towards `side`.
  void wall(double side, double x0, double x1, double near, double far, double z0, double z1);
  void build_shell(bool is_closed);
  /// The wall to the corridor with its door, and the wall to the next room.
  void build_walls(const Room& room);
  void build_windows(const Room& room);

  // storey_furniture.cpp
  using Add = void (*)(TriangleMesh&, const Eigen::Isometry3d&, Rng&);
  /// With its back (+y) to one of the walls.
  void put_at_wall(const Room& room, Add add, const Eigen::Vector2d& half_size);
  void put_anywhere(const Room& room, Add add, const Eigen::Vector2d& half_size);
  void put(const Footprint& spot, Add add);
  void furnish(const Room& room);
  void furnish_corridor();

  /// From the first room on one side into the corridor, into a room half way, and into the last room on the other side.
  void lay_path();

  /// From a room into the corridor, into a room of the other side, and to the corridor's end.
  void lay_path_to_end();

  /// Around the path that is laid.
  void build_rooms(bool is_closed);

  /// Nothing is put where it leads.
  void keep_path_free();

  const double length_m_;
  Rng &rng_, &contents_;
  const double height_m_, half_corridor_m_;
  std::vector<Room> rooms_;
  SitePlan plan_;
  Scene scene_;
};

}  // namespace tcm_icp
