// A street through a town: ground, kerbs, and objects set where there is room.

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "simulation/draw.hpp"
#include "simulation/ground.hpp"
#include "simulation/site_plan.hpp"
#include "simulation/town_objects.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHalfRoad_m = 3.2;
constexpr int kAttempts = 3000;

void require_count(const char* field, int value) {
  if (value < 0 || value > 1000) {
    throw InvalidOptions("town: " + std::string(field) + " = " + std::to_string(value) + "; needs 0..1000");
  }
}

class Town {
 public:
  Town(const TownOptions& options, Rng& rng) : options_(options), rng_(rng), ground_(rng) {}

  Scene build() {
    // Ground goes on beyond the houses, so that the scanner sees a horizon of returns and not an edge.
    ground_.add_to(scene_.mesh, 2 * options_.half_size_m);
    lay_street();
    place("num_buildings", options_.num_buildings, [&] { return try_house(); });
    place("num_sheds", options_.num_sheds, [&] { return try_shed(); });
    place("num_cars", options_.num_cars, [&] { return try_car(); });
    place("num_lamps", options_.num_lamps, [&] { return try_lamp(); });
    place("num_trees", options_.num_trees, [&] { return try_plant(1.2, add_tree); });
    place("num_bushes", options_.num_bushes, [&] { return try_plant(0.6, add_bush); });
    place("num_fences", options_.num_fences, [&] { return try_fence(); });
    return std::move(scene_);
  }

 private:
  /// Four points with two bends, and kerb stones with gaps (drives) on both sides.
  void lay_street() {
    const double h = options_.half_size_m;
    Points bends;
    for (const Vector2d& p :
         {Vector2d(-0.85, -0.35), Vector2d(-0.25, 0.12), Vector2d(0.3, -0.1), Vector2d(0.85, 0.4)}) {
      const double dx = uniform(rng_, -0.06, 0.06);
      const double dy = uniform(rng_, -0.1, 0.1);
      bends.push_back({h * (p.x() + dx), h * (p.y() + dy), 0});
    }
    const int length_m = static_cast<int>(path_length_m(bends));
    for (int s = 0; s <= length_m; ++s) scene_.path.push_back(ground_.lift(along_path(bends, s).position.head<2>()));
    for (int s = 0; s < length_m; ++s) {
      const PathPoint here = along_path(scene_.path, s);
      plan_.take({here.position.head<2>(), here.heading_rad, {1, kHalfRoad_m}});
      for (const double side : {-1.0, 1.0}) {
        if (uniform01(rng_) < 0.15) continue;
        const Isometry3d T = beside_street(here, side * (kHalfRoad_m - 0.15));
        add_box(scene_.mesh, T, Eigen::AlignedBox3d(Vector3d(-0.5, -0.15, -0.3), Vector3d(0.5, 0.15, 0.14)), 0.55);
      }
    }
  }

  void place(const std::string& what, int count, const std::function<bool()>& attempt) {
    for (int placed = 0; placed < count; ++placed) {
      int tries = 0;
      while (!attempt()) {
        if (++tries < kAttempts) continue;
        throw InvalidOptions("town: " + what + " = " + std::to_string(count) + ": only " + std::to_string(placed) +
                             " find room; needs fewer of them or a larger half_size_m");
      }
    }
  }

  Isometry3d standing(const Footprint& f) const { return upright_pose(ground_.lift(f.centre), f.heading_rad); }

  Isometry3d beside_street(const PathPoint& at, double offset_m) const {
    const Vector2d left(-std::sin(at.heading_rad), std::cos(at.heading_rad));
    return upright_pose(ground_.lift(at.position.head<2>() + offset_m * left), at.heading_rad);
  }

  PathPoint random_street_point() { return along_path(scene_.path, uniform01(rng_) * path_length_m(scene_.path)); }

  /// A place at `distance_m` from the middle of the street, turned with it.
  Footprint random_site(const Vector2d& half_size_m, double min_distance_m, double max_distance_m) {
    const PathPoint street = random_street_point();
    const double side = uniform01(rng_) < 0.5 ? -1 : 1;
    const double distance = uniform(rng_, min_distance_m, max_distance_m);
    const double turn = uniform(rng_, -0.2, 0.2);
    return {beside_street(street, side * distance).translation().head<2>(), street.heading_rad + turn, half_size_m};
  }

  bool claim(const Footprint& f, double margin_m) {
    if (f.centre.cwiseAbs().maxCoeff() > options_.half_size_m || !plan_.is_free(f, margin_m)) return false;
    plan_.take(f);
    return true;
  }

  bool try_house() {
    House house;
    house.half_size_m.x() = uniform(rng_, 4, 7.5);
    house.half_size_m.y() = uniform(rng_, 3, std::min(5.0, house.half_size_m.x()));
    house.num_storeys = 1 + static_cast<int>(uniform_index(rng_, 3));
    house.roof_rise_m = uniform(rng_, 0.4, 1.0) * house.half_size_m.y();
    house.window_width_m = uniform(rng_, 0.8, 1.5);
    house.cell_width_m = uniform(rng_, 2.1, 3.4);
    house.reflectivity = uniform(rng_, 0.4, 0.8);
    const Footprint site = random_site(house.half_size_m, kHalfRoad_m + house.half_size_m.y(), 24);
    if (!claim(site, 1.5)) return false;
    add_house(scene_.mesh, standing(site), house, rng_);
    return true;
  }

  bool try_shed() {
    const double x = uniform(rng_, 1.6, 2.6);
    const double y = uniform(rng_, 2, 3);
    const Footprint site = random_site({x, y}, kHalfRoad_m + 3, 20);
    if (!claim(site, 1)) return false;
    add_shed(scene_.mesh, standing(site), site.half_size_m, rng_);
    return true;
  }

  /// Beside the road, half on the pavement: the road itself is the path and stays free.
  bool try_car() {
    const PathPoint street = random_street_point();
    const double side = uniform01(rng_) < 0.5 ? -1 : 1;
    const Isometry3d T = beside_street(street, side * (kHalfRoad_m + 0.9));
    const Footprint site{T.translation().head<2>(), street.heading_rad, {2.6, 0.85}};
    if (!claim(site, 0)) return false;
    add_car(scene_.mesh, T, rng_);
    return true;
  }

  /// The arm (along x) reaches over the road.
  bool try_lamp() {
    const PathPoint street = random_street_point();
    const double side = uniform01(rng_) < 0.5 ? -1 : 1;
    Isometry3d T = beside_street(street, side * (kHalfRoad_m + 0.4));
    const Footprint site{T.translation().head<2>(), street.heading_rad, {0.15, 0.15}};
    if (!claim(site, 0.2)) return false;
    T.rotate(Eigen::AngleAxisd(-side * std::numbers::pi / 2, Vector3d::UnitZ()));
    add_lamp(scene_.mesh, T, rng_);
    return true;
  }

  bool try_plant(double half_size_m, void (*add)(TriangleMesh&, const Isometry3d&, Rng&)) {
    const Footprint site = random_site({half_size_m, half_size_m}, kHalfRoad_m + 1, options_.half_size_m);
    if (!claim(site, 0.2)) return false;
    add(scene_.mesh, standing(site), rng_);
    return true;
  }

  bool try_fence() {
    const double length = uniform(rng_, 4, 9);
    const Footprint site = random_site({length / 2, 0.2}, kHalfRoad_m + 1.5, 15);
    if (!claim(site, 0.2)) return false;
    add_fence(scene_.mesh, standing(site), length);
    return true;
  }

  const TownOptions& options_;
  Rng& rng_;
  Ground ground_;
  SitePlan plan_;
  Scene scene_;
};

}  // namespace

void TownOptions::validate() const {
  if (!(half_size_m >= 10 && half_size_m <= 1000)) {
    throw InvalidOptions("town: half_size_m = " + std::to_string(half_size_m) + "; needs 10..1000");
  }
  require_count("num_buildings", num_buildings);
  require_count("num_sheds", num_sheds);
  require_count("num_trees", num_trees);
  require_count("num_bushes", num_bushes);
  require_count("num_cars", num_cars);
  require_count("num_lamps", num_lamps);
  require_count("num_fences", num_fences);
}

Scene make_town_scene(const TownOptions& options, Rng& rng) {
  options.validate();
  return Town(options, rng).build();
}

}  // namespace tcm_icp
