// What stands on the lots along a street.

#include <algorithm>

#include "simulation/city_building.hpp"
#include "simulation/draw.hpp"
#include "simulation/street_builder.hpp"
#include "simulation/street_furniture.hpp"
#include "simulation/town_objects.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector2d;

constexpr double kStep_m = 2;  // to the next place that is tried where a building finds no room

}  // namespace

void StreetBuilder::line_side(double side) {
  for (double begin = 0; begin < length_m_;) {
    const double end = std::min(begin + uniform(rng_, 25, 70), length_m_);
    const double kind = uniform01(rng_);
    build_stretch(kind < style_.closed_front_share                           ? Character::kClosedFront
                  : kind < style_.closed_front_share + style_.detached_share ? Character::kDetached
                                                                             : Character::kOpen,
                  side, begin, end);
    begin = end;
    if (uniform01(rng_) < 0.5) begin += uniform(rng_, 5, 10);  // a side street, or a yard
  }
}

void StreetBuilder::build_stretch(Character character, double side, double begin_m, double end_m) {
  const bool has_front_yards = uniform01(rng_) < 0.3;
  const double yard = uniform(rng_, 1, 4);
  const double setback = has_front_yards ? yard : 0;
  const int num_storeys = 2 + static_cast<int>(uniform_index(rng_, 4));
  if (character == Character::kOpen) return plant_open_ground(side, begin_m, end_m);
  for (double s = begin_m; s < end_m - 5;) {
    s = character == Character::kClosedFront ? build_terraced(side, s, setback, num_storeys) : build_detached(side, s);
  }
}

double StreetBuilder::build_terraced(double side, double at_m, double setback_m, int num_storeys) {
  const double width = uniform(rng_, 7, 22);
  const double depth = uniform(rng_, 9, 13);
  const bool is_moved = uniform01(rng_) < 0.35;
  const double moved = uniform(rng_, 0, 1.5);
  const double clearance = half_road_m_ + pavement_m_ + setback_m + (is_moved ? moved : 0);
  const int storeys = std::clamp(num_storeys - 1 + static_cast<int>(uniform_index(rng_, 3)), 1, 6);
  for (const double share : {1.0, 0.6, 0.4}) {
    const Vector2d half_size = Vector2d(std::max(5.0, share * width), share < 1 ? 0.7 * depth : depth) / 2;
    const Footprint lot = site(side, at_m, half_size, clearance);
    if (!claim_lot(lot, -0.02)) continue;  // side by side is not in the way
    const CityBuilding building = random_city_building(half_size, storeys, rng_);
    add_city_building(scene_.mesh, standing(lot), building, rng_);
    if (setback_m > 1) enclose(side, at_m, 2 * half_size.x());
    const double gap = uniform(rng_, 1.5, 4.5);
    return at_m + 2 * half_size.x() + (uniform01(rng_) < 0.15 ? gap : 0);
  }
  return at_m + kStep_m;
}

double StreetBuilder::build_detached(double side, double at_m) {
  House house;
  house.half_size_m.x() = uniform(rng_, 4, 7);
  house.half_size_m.y() = uniform(rng_, 3, 5);
  house.num_storeys = 1 + static_cast<int>(uniform_index(rng_, 3));
  house.roof_rise_m = uniform(rng_, 0.4, 1.0) * house.half_size_m.y();
  house.window_width_m = uniform(rng_, 0.8, 1.5);
  house.cell_width_m = uniform(rng_, 2.1, 3.4);
  house.reflectivity = uniform(rng_, 0.4, 0.8);
  Footprint lot = site(side, at_m, house.half_size_m, half_road_m_ + pavement_m_ + uniform(rng_, 2, 7));
  lot.heading_rad += uniform(rng_, -0.12, 0.12);
  const double end = at_m + 2 * house.half_size_m.x() + uniform(rng_, 3, 9);
  if (!claim_lot(lot, 1)) return at_m + kStep_m;
  add_house(scene_.mesh, standing(lot), house, rng_);
  enclose(side, at_m, end - at_m);
  plant_open_ground(side, at_m, end);
  const double x = uniform(rng_, 1.6, 2.6);
  const Footprint shed = site(side, end - 2 * x, {x, uniform(rng_, 2, 3)}, half_road_m_ + pavement_m_ + 4);
  if (uniform01(rng_) < 0.4 && claim_lot(shed, 0.5)) add_shed(scene_.mesh, standing(shed), shed.half_size_m, rng_);
  return end;
}

/// A fence, a wall, a hedge or nothing between pavement and lot.
void StreetBuilder::enclose(double side, double at_m, double length_m) {
  const double kind = uniform01(rng_);
  const double gate = std::min(uniform(rng_, 1, 3), length_m / 3);
  const Footprint line = site(side, at_m, {(length_m - gate) / 2, 0.2}, half_road_m_ + pavement_m_ + 0.2);
  if (kind < 0.15 || !claim_lot(line, 0.05)) return;
  const double length = 2 * line.half_size_m.x();
  if (kind < 0.45) return add_fence(scene_.mesh, standing(line), length);
  if (kind < 0.75) return add_garden_wall(scene_.mesh, standing(line), length, rng_);
  add_hedge(scene_.mesh, standing(line), length, rng_);
}

void StreetBuilder::plant_open_ground(double side, double begin_m, double end_m) {
  const double length = end_m - begin_m;
  if (length > 20) enclose(side, begin_m, length);
  const int num_plants = static_cast<int>(length / uniform(rng_, 3, 8));
  for (int i = 0; i < num_plants; ++i) {
    const bool is_tree = uniform01(rng_) < 0.5;
    const double half = is_tree ? 1.0 : 0.5;
    const double s = uniform(rng_, begin_m, end_m);
    const double distance = half_road_m_ + pavement_m_ + uniform(rng_, 1, 16);
    const Footprint spot = site(side, s, {half, half}, distance);
    if (!claim_lot(spot, 0.3)) continue;
    (is_tree ? style_.add_tree : add_bush)(scene_.mesh, standing(spot), rng_);
  }
}

/// Houses behind the front, seen through its gaps.
void StreetBuilder::build_second_row() {
  const int tries = static_cast<int>(length_m_ / 6);
  for (int i = 0; i < tries; ++i) {
    const double width = uniform(rng_, 8, 18);
    const double depth = uniform(rng_, 8, 12);
    const Vector2d half_size = Vector2d(width, depth) / 2;
    const double side = uniform01(rng_) < 0.5 ? -1 : 1;
    const double s = uniform(rng_, 0, length_m_);
    const double clearance = uniform(rng_, 22, 34);
    const int num_storeys = 2 + static_cast<int>(uniform_index(rng_, 4));
    const Footprint lot = site(side, s, half_size, clearance);
    if (!claim_lot(lot, 1.5)) continue;
    add_city_building(scene_.mesh, standing(lot), random_city_building(half_size, num_storeys, rng_), rng_);
  }
}

}  // namespace tcm_icp
