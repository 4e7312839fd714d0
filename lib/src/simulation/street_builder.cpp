#include "simulation/street_builder.hpp"

#include <cmath>
#include <numbers>

#include "simulation/draw.hpp"

namespace tcm_icp {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

StreetBuilder::StreetBuilder(const Points& middle, Rng& rng, const StreetStyle& style)
    : rng_(rng),
      ground_(rng),
      middle_(middle),
      length_m_(path_length_m(middle)),
      is_closed_(middle.front() == middle.back()),
      style_(style),
      half_road_m_(uniform(rng, 4.2, 5)),
      pavement_m_(uniform(rng, 2.2, 3.2)) {}

Scene StreetBuilder::build() {
  lay_road();
  lay_kerbs();
  for (const double side : {-1.0, 1.0}) line_side(side);
  build_second_row();
  if (style_.has_wires) string_wires(uniform01(rng_) < 0.5 ? -1 : 1);
  for (const double side : {-1.0, 1.0}) furnish_side(side);
  return std::move(scene_);
}

PathPoint StreetBuilder::at(double distance_m) const {
  if (is_closed_) distance_m -= length_m_ * std::floor(distance_m / length_m_);
  return along_path(middle_, distance_m);
}

void StreetBuilder::lay_road() {
  // Beyond the lots, so that who looks through a gap sees ground and no edge.
  constexpr double kReach_m = 45;
  const int last = static_cast<int>(length_m_);
  for (int s = 0; s <= last; ++s) scene_.path.push_back(ground_.lift(at(s).position.head<2>()));
  if (is_closed_) scene_.path.push_back(scene_.path.front());
  ground_.add_along(scene_.mesh, scene_.path, kReach_m);
  for (int s = 0; s <= last; ++s) {
    const PathPoint here = at(s);
    plan_.take({here.position.head<2>(), here.heading_rad, {1, half_road_m_ - 2.4}});  // the lanes; cars park beside
    // A metre of tolerance: where the street bends, a straight front cannot follow it.
    road_.take({here.position.head<2>(), here.heading_rad, {1, half_road_m_ + pavement_m_ - 1}});
  }
}

void StreetBuilder::lay_kerbs() {
  for (int s = 0; s + 1 <= static_cast<int>(length_m_); ++s) {
    for (const double side : {-1.0, 1.0}) {
      if (uniform01(rng_) < 0.1) continue;  // a drive
      const Footprint stone = site(side, s, {0.5, 0.15}, half_road_m_ - 0.3);
      if (!plan_.is_free(stone, 0)) continue;  // another street's lanes
      add_box(scene_.mesh, standing(stone), Eigen::AlignedBox3d(Vector3d(-0.5, -0.15, -0.3), Vector3d(0.5, 0.15, 0.14)),
              0.55);
    }
  }
}

Footprint StreetBuilder::site(double side, double begin_m, const Vector2d& half_size_m, double clearance_m) const {
  const Vector3d from = at(begin_m).position, to = at(begin_m + 2 * half_size_m.x()).position;
  Vector3d along = to - from;
  if (along.norm() < 0.1) along = from - at(begin_m - 1).position;  // at the end of an open street
  const double heading = std::atan2(along.y(), along.x());
  const Vector2d left(-std::sin(heading), std::cos(heading));
  const Vector2d centre = (from + to).head<2>() / 2 + side * (clearance_m + half_size_m.y()) * left;
  return {centre, side > 0 ? heading : heading + std::numbers::pi, half_size_m};
}

bool StreetBuilder::claim(const Footprint& footprint, double margin_m) {
  if (!plan_.is_free(footprint, margin_m)) return false;
  plan_.take(footprint);
  return true;
}

bool StreetBuilder::claim_lot(const Footprint& footprint, double margin_m) {
  return road_.is_free(footprint, 0) && claim(footprint, margin_m);
}

Isometry3d StreetBuilder::standing(const Footprint& f) const {
  return upright_pose(ground_.lift(f.centre), f.heading_rad);
}

}  // namespace tcm_icp
