// A building whose storeys are alike: the same rooms and windows above one another, other furniture, one staircase.

#include <algorithm>
#include <string>

#include "simulation/box.hpp"
#include "simulation/require_length.hpp"
#include "simulation/stairs.hpp"
#include "simulation/storey.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSlab_m = 0.3;
constexpr double kBeforeStairs_m = 1.5;  ///< from the corridor's end to the first step

/// The staircase at the far end of all corridors.
struct StairHall {
  double begin_m, storey_m;  ///< where the corridors end along x; from floor to floor
  int storeys;
  double half_width_m = Stairs::width_m() / 2 + 0.1;

  AlignedBox2d opening() const {
    const double x = begin_m + kBeforeStairs_m;
    return {Vector2d(x, -half_width_m), Vector2d(x + Stairs::length_m(storey_m) + 0.1, half_width_m)};
  }
  Stairs stairs() const { return {opening(), storey_m}; }
  double end_m() const { return opening().max().x(); }
};

void add_stair_hall(TriangleMesh& mesh, const StairHall& hall) {
  const Isometry3d T = Isometry3d::Identity();
  const double top = hall.storeys * hall.storey_m - kSlab_m, y = hall.half_width_m, x = hall.begin_m;
  for (const double side : {-1.0, 1.0})
    add_box(mesh, T,
            box(x, hall.end_m(), std::min(side * y, side * (y + 0.1)), std::max(side * y, side * (y + 0.1)), 0, top),
            kPlaster);
  add_box(mesh, T, box(hall.end_m(), hall.end_m() + 0.1, -y - 0.1, y + 0.1, 0, top), kPlaster);
  for (const double z : {0.0, top})
    add_quad(mesh, {x, -y, z}, {hall.end_m(), -y, z}, {hall.end_m(), y, z}, {x, y, z}, kConcrete);
  for (int storey = 1; storey < hall.storeys; ++storey) {
    const double floor = storey * hall.storey_m;
    add_box(mesh, T, box(x, x + kBeforeStairs_m, -y, y, floor - kSlab_m, floor), kConcrete);
    hall.stairs().add_to(mesh, floor - hall.storey_m);
    hall.stairs().guard(mesh, floor);
  }
}

void append(TriangleMesh& mesh, const TriangleMesh& part, double up_m) {
  const Vector3d up(0, 0, up_m);
  for (Triangle t : part.triangles) {
    for (Vector3d* corner : {&t.a, &t.b, &t.c}) *corner += up;
    mesh.triangles.push_back(t);
  }
}

void append(Points& path, const Points& part, double up_m) {
  for (const Vector3d& p : part) path.emplace_back(p.x(), p.y(), p.z() + up_m);
}

/// From the stairs to a corridor's rooms and, but on the last storey, back to them by the shortest way.
void add_storey_path(Points& path, const Points& room_to_end, int storey, const StairHall& hall) {
  const double floor = storey * hall.storey_m;
  if (storey > 0) append(path, Points(room_to_end.rbegin(), room_to_end.rend()), floor);
  if (storey + 1 == hall.storeys) return;
  if (storey == 0) {
    append(path, room_to_end, floor);
  } else {
    append(path, {room_to_end.begin() + 1, room_to_end.begin() + 3}, floor);  // out of the last room
    append(path, {room_to_end.end() - 1, room_to_end.end()}, floor);
  }
  append(path, hall.stairs().path(floor), 0);
}

}  // namespace

void StoreysOptions::validate() const {
  if (!(storeys >= 2 && storeys <= 10))
    throw InvalidOptions("storeys: storeys = " + std::to_string(storeys) + "; needs 2..10");
  require_length("storeys: length_m", length_m, 12, 500);
}

Scene make_storeys_scene(const StoreysOptions& options, Rng& rng) {
  options.validate();
  const std::uint64_t plan = rng();
  Scene scene;
  for (int i = 0; i < options.storeys; ++i) {
    Rng same_plan = make_stream(plan, "storey");
    Storey storey(options.length_m, same_plan, rng);
    const StairHall hall{options.length_m, storey.height_m() + kSlab_m, options.storeys};
    const Scene one = storey.build_before_stairs();
    append(scene.mesh, one.mesh, i * hall.storey_m);
    add_storey_path(scene.path, one.path, i, hall);
    scene.free_half_width_m = one.free_half_width_m;
    if (i == 0) add_stair_hall(scene.mesh, hall);
  }
  return scene;
}

}  // namespace tcm_icp
