// A square: a palace on one side, town houses on the others.

#include <cmath>
#include <numbers>

#include "simulation/city_building.hpp"
#include "simulation/draw.hpp"
#include "simulation/ground.hpp"
#include "simulation/palace.hpp"
#include "simulation/park_furniture.hpp"
#include "simulation/require_length.hpp"
#include "simulation/site_plan.hpp"
#include "simulation/street_furniture.hpp"
#include "simulation/town_objects.hpp"
#include "simulation/tree.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

class Square {
 public:
  Square(const PlazaOptions& options, Rng& rng) : half_m_(options.half_size_m), rng_(rng), ground_(rng) {}

  Scene build() {
    ground_.add_to(scene_.mesh, half_m_ + 35);
    lay_path();
    add_palace(scene_.mesh, upright_pose(ground_.lift({0, half_m_}), 0), 0.72 * half_m_, rng_);
    for (int side = 1; side < 4; ++side) build_side(side * std::numbers::pi / 2);
    put(1, 0.35, add_fountain, {3.3, 3.3});
    put(2, 0.6, add_statue, {1, 0.8});
    line_with_lamps();
    plant_row();
    put(10, 0.85, add_bench, {1, 0.35});
    put(5, 0.85, add_car, {2.5, 1});
    put(3, 0.85, add_poster_column, {0.85, 0.85});
    put(2, 0.85, add_shelter, {2.5, 0.9});
    put(6, 0.9, add_cabinet, {0.9, 0.4});
    put(8, 0.9, add_sign, {0.1, 0.4});
    put(16, 0.8, add_bollard, {0.2, 0.2});
    put(4, 0.8, add_broadleaf_tree, {0.8, 0.8});
    return std::move(scene_);
  }

 private:
  Isometry3d standing(const Footprint& f) const { return upright_pose(ground_.lift(f.centre), f.heading_rad); }

  /// A bent way across, from near one corner to the opposite side.
  void lay_path() {
    Points bends;
    for (const Vector2d& p : {Vector2d(-0.7, -0.6), Vector2d(-0.35, 0.3), Vector2d(0.25, -0.15), Vector2d(0.7, 0.45)}) {
      const double dx = uniform(rng_, -0.1, 0.1);
      const double dy = uniform(rng_, -0.1, 0.1);
      bends.push_back({half_m_ * (p.x() + dx), half_m_ * (p.y() + dy), 0});
    }
    for (double s = 0; s < path_length_m(bends); s += 1) {
      const PathPoint here = along_path(bends, s);
      scene_.path.push_back(ground_.lift(here.position.head<2>()));
      plan_.take({here.position.head<2>(), here.heading_rad, {1, 1.9}});
    }
  }

  /// Houses side by side along the side that `heading_rad` turns to the front (+y before turning), with a street.
  void build_side(double heading_rad) {
    const Eigen::Rotation2Dd turn(heading_rad);
    const double street = half_m_ * uniform(rng_, -0.6, 0.6);
    for (double x = -half_m_; x < half_m_ - 5;) {
      const double width = std::min(uniform(rng_, 8, 20), half_m_ - x);
      const double depth = uniform(rng_, 9, 13);
      const int storeys = 2 + static_cast<int>(uniform_index(rng_, 4));
      const Vector2d half_size = Vector2d(width, depth) / 2;
      const Footprint lot{turn * Vector2d(x + width / 2, half_m_ + depth / 2), heading_rad, half_size};
      x += width;
      const CityBuilding building = random_city_building(half_size, storeys, rng_);
      add_city_building(scene_.mesh, standing(lot), building, rng_);
      if (x > street && x - width < street) x += uniform(rng_, 5, 8);
    }
  }

  void put(int count, double reach_share, void (*add)(TriangleMesh&, const Isometry3d&, Rng&),
           const Vector2d& half_size) {
    constexpr int kAttempts = 20;
    for (int i = 0; i < count; ++i) {
      for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const double x = uniform(rng_, -reach_share, reach_share) * half_m_;
        const double y = uniform(rng_, -reach_share, std::min(reach_share, 0.75)) * half_m_;  // the portico's steps
        const double heading = uniform(rng_, -std::numbers::pi, std::numbers::pi);
        if (place({{x, y}, heading, half_size}, add)) break;
      }
    }
  }

  bool place(const Footprint& spot, void (*add)(TriangleMesh&, const Isometry3d&, Rng&)) {
    if (!plan_.is_free(spot, 0.3)) return false;
    plan_.take(spot);
    add(scene_.mesh, standing(spot), rng_);
    return true;
  }

  /// Two rows towards the palace, each the other's mirror image, but for lamps that would be in the way.
  void line_with_lamps() {
    for (double y = -0.7 * half_m_; y < 0.7 * half_m_; y += 11)
      for (const double side : {-1.0, 1.0})
        place({{side * 0.4 * half_m_, y}, side > 0 ? std::numbers::pi : 0, {0.2, 0.2}}, add_lamp);
  }

  /// Trees along one side only.
  void plant_row() {
    const double side = uniform01(rng_) < 0.5 ? -1 : 1;
    for (double y = -0.8 * half_m_; y < 0.6 * half_m_; y += uniform(rng_, 5.5, 7.5))
      place({{side * 0.8 * half_m_, y}, 0, {0.8, 0.8}}, add_broadleaf_tree);
  }

  const double half_m_;
  Rng& rng_;
  const Ground ground_;
  SitePlan plan_;
  Scene scene_;
};

}  // namespace

void PlazaOptions::validate() const { require_length("plaza: half_size_m", half_size_m, 22, 200); }

Scene make_plaza_scene(const PlazaOptions& options, Rng& rng) {
  options.validate();
  return Square(options, rng).build();
}

}  // namespace tcm_icp
