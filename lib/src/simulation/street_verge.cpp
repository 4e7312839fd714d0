// What stands in a street: wires, parked cars, trees along the kerb, lamps, signs and what else is in the way of a
// pram.

#include <algorithm>
#include <numbers>

#include "simulation/draw.hpp"
#include "simulation/overhead_line.hpp"
#include "simulation/street_builder.hpp"
#include "simulation/street_furniture.hpp"
#include "simulation/town_objects.hpp"

namespace tcm_icp {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

void StreetBuilder::string_wires(double side) {
  const double height = uniform(rng_, 7, 9);
  Points last;
  for (double s = uniform(rng_, 0, 10); s < length_m_; s += uniform(rng_, 24, 34)) {
    const Footprint spot = site(side, s, {0.2, 0.2}, half_road_m_ + 0.4);
    if (!claim(spot, 0.1)) continue;
    const Points carriers = add_utility_pole(scene_.mesh, standing(spot), height);
    // Whose front faces the street has its arm across it, since x runs along: the order of the places is the same.
    if (!last.empty()) add_span(scene_.mesh, last, carriers);
    last = carriers;
  }
}

void StreetBuilder::furnish_side(double side) {
  for (double begin = 0; begin < length_m_;) {
    const double end = std::min(begin + uniform(rng_, 25, 60), length_m_);
    const double occupancy = uniform(rng_, 0.05, 0.75);
    const double spacing = uniform(rng_, 6, 14);
    put_small_objects(side, begin, end);
    if (uniform01(rng_) < style_.avenue_share) plant_avenue(side, begin, end, spacing);
    park_cars(side, begin, end, occupancy);
    begin = end;
  }
}

void StreetBuilder::park_cars(double side, double begin_m, double end_m, double occupancy) {
  for (double s = begin_m + uniform(rng_, 0, 4); s < end_m;) {
    const bool is_van = uniform01(rng_) < 0.15;
    const bool is_turned = uniform01(rng_) < 0.5;
    const bool is_taken = uniform01(rng_) < occupancy;
    const double from_kerb = uniform(rng_, 0.1, 0.4);
    const Vector2d half_size(is_van ? 2.9 : 2.4, 0.97);
    Footprint place = site(side, s, half_size, half_road_m_ - from_kerb - 2 * half_size.y());
    s += 2 * half_size.x() + uniform(rng_, 0.4, 1.5);
    if (!is_taken || !claim(place, 0)) continue;
    place.heading_rad += uniform(rng_, -0.04, 0.04) + (is_turned ? std::numbers::pi : 0);
    (is_van ? add_van : add_car)(scene_.mesh, standing(place), rng_);
  }
}

void StreetBuilder::plant_avenue(double side, double begin_m, double end_m, double spacing_m) {
  for (double s = begin_m; s < end_m; s += spacing_m) {
    const double at_m = s + uniform(rng_, -1, 1);
    if (uniform01(rng_) < 0.15) continue;  // one that was not replaced
    const Footprint spot = site(side, at_m, {0.4, 0.4}, half_road_m_ + 0.2);
    if (claim(spot, 0.2)) style_.add_tree(scene_.mesh, standing(spot), rng_);
  }
}

void StreetBuilder::put_small_objects(double side, double begin_m, double end_m) {
  using Add = void (*)(TriangleMesh&, const Isometry3d&, Rng&);
  struct Kind {
    Add add;
    Vector2d half_size_m;
    double spacing_m;  ///< one in so many metres, on average
  };
  static const Kind kKinds[] = {{add_lamp, {0.15, 0.15}, 28},   {add_sign, {0.1, 0.1}, 16},
                                {add_bollard, {0.2, 0.2}, 9},   {add_cabinet, {0.9, 0.35}, 20},
                                {add_shelter, {2.5, 0.9}, 150}, {add_poster_column, {0.8, 0.8}, 90}};
  for (const Kind& kind : kKinds) {
    const int count = static_cast<int>((end_m - begin_m) / kind.spacing_m + uniform01(rng_));
    for (int i = 0; i < count; ++i) {
      const double s = uniform(rng_, begin_m, end_m);
      const double from_kerb = uniform(rng_, 0.2, 0.5);
      const Footprint spot = site(side, s, kind.half_size_m, half_road_m_ + from_kerb);
      if (!claim(spot, 0.15)) continue;
      Isometry3d T = standing(spot);
      if (kind.add == add_lamp) T.rotate(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitZ()));  // over the road
      kind.add(scene_.mesh, T, rng_);
    }
  }
}

}  // namespace tcm_icp
