// A storey, and the way through it.

#include <algorithm>
#include <string>

#include "simulation/draw.hpp"
#include "simulation/storey.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

using Eigen::Vector3d;

Storey::Storey(const InteriorOptions& options, Rng& rng)
    : length_m_(options.length_m),
      rng_(rng),
      height_m_(uniform(rng, 2.6, 3.1)),
      half_corridor_m_(uniform(rng, 0.9, 1.3)) {}

Scene Storey::build() {
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

void Storey::lay_path() {
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

void InteriorOptions::validate() const {
  if (!(length_m >= 15 && length_m <= 500))
    throw InvalidOptions("interior: length_m = " + std::to_string(length_m) + "; needs 15..500");
}

Scene make_interior_scene(const InteriorOptions& options, Rng& rng) {
  options.validate();
  return Storey(options, rng).build();
}

}  // namespace tcm_icp
