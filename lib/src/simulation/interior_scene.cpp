// A storey, and the way through it.

#include <algorithm>

#include "simulation/draw.hpp"
#include "simulation/require_length.hpp"
#include "simulation/storey.hpp"

namespace tcm_icp {

using Eigen::Vector3d;

Storey::Storey(double length_m, Rng& plan, Rng& contents)
    : length_m_(length_m),
      rng_(plan),
      contents_(contents),
      height_m_(uniform(plan, 2.6, 3.1)),
      half_corridor_m_(uniform(plan, 0.9, 1.3)) {
  for (const double side : {-1.0, 1.0}) divide(side);
}

Scene Storey::build() {
  lay_path();
  build_rooms(true);
  return std::move(scene_);
}

Scene Storey::build_before_stairs() {
  lay_path_to_end();
  build_rooms(false);
  return std::move(scene_);
}

void Storey::build_rooms(bool is_closed) {
  keep_path_free();
  build_shell(is_closed);
  for (const Room& room : rooms_) {
    build_walls(room);
    build_windows(room);
    furnish(room);
  }
  furnish_corridor();
  scene_.free_half_width_m = 0.25;
}

namespace {

Vector3d before_door(const Room& r) { return {r.door_m, r.side * (r.near_m + 0.9), 0}; }
Vector3d at_door(const Room& r) { return {r.door_m, 0, 0}; }

}  // namespace

void Storey::lay_path() {
  const auto first = std::find_if(rooms_.begin(), rooms_.end(), [](const Room& r) { return r.side > 0; });
  const auto half_way = std::find_if(first, rooms_.end(), [&](const Room& r) { return r.end_m > 0.55 * length_m_; });
  const Room& last = *(first - 1);
  scene_.path = {first->centre(), before_door(*first), at_door(*first)};
  if (half_way->begin_m > first->begin_m)
    for (const Vector3d& p : {at_door(*half_way), half_way->centre(), before_door(*half_way), at_door(*half_way)})
      scene_.path.push_back(p);
  for (const Vector3d& p : {at_door(last), before_door(last), last.centre()}) scene_.path.push_back(p);
}

void Storey::lay_path_to_end() {
  std::vector<Room> far, middle;
  const double side = uniform01(contents_) < 0.5 ? -1 : 1;
  for (const Room& r : rooms_) {
    if (r.side == side && r.begin_m == 0) far.push_back(r);
    if (r.side != side && r.door_m > length_m_ / 3 && r.door_m < 0.8 * length_m_) middle.push_back(r);
  }
  const Room& first = far.front();
  scene_.path = {first.centre(), before_door(first), at_door(first)};
  if (!middle.empty()) {
    const Room& second = middle[uniform_index(contents_, middle.size())];
    for (const Vector3d& p :
         {at_door(second), before_door(second), second.centre(), before_door(second), at_door(second)})
      scene_.path.push_back(p);
  }
  scene_.path.emplace_back(length_m_, 0, 0);
}

void Storey::keep_path_free() {
  for (double s = 0; s < path_length_m(scene_.path); s += 0.3) {
    const PathPoint here = along_path(scene_.path, s);
    plan_.take({here.position.head<2>(), here.heading_rad, {0.3, 0.6}});
  }
}

void InteriorOptions::validate() const { require_length("interior: length_m", length_m, 15, 500); }

Scene make_interior_scene(const InteriorOptions& options, Rng& rng) {
  options.validate();
  return Storey(options.length_m, rng, rng).build();
}

}  // namespace tcm_icp
