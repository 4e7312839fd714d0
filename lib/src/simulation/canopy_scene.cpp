// A park at a lake: shore, trail, open forest, and many small things.

#include <cmath>
#include <numbers>

#include "simulation/draw.hpp"
#include "simulation/overhead_line.hpp"
#include "simulation/park_furniture.hpp"
#include "simulation/require_length.hpp"
#include "simulation/shore.hpp"
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

constexpr double kMargin_m = 30;       // forest goes on beyond both ends of the trail
constexpr double kForestDepth_m = 48;  // from the water

using AddObject = void (*)(TriangleMesh&, const Isometry3d&, Rng&);

/// One in so many square metres of the strip between two distances from the water.
struct Assets {
  AddObject add;
  Vector2d half_size_m;
  double nearest_m, farthest_m;
  double area_m2;
};

void add_shed_of_any_size(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 1.4, 2.2);
  const double y = uniform(rng, 1.4, 2.2);
  add_shed(mesh, T, {x, y}, rng);
}

constexpr double kTrail_m = 9;  // from the water

class Park {
 public:
  Park(const CanopyOptions& options, Rng& rng) : length_m_(options.length_m), rng_(rng), shore_(rng) {}

  Scene build() {
    shore_.add_to(scene_.mesh, -kMargin_m - 15, length_m_ + kMargin_m + 15);
    lay_trail();
    string_power_line();
    build_jetties();
    park_cars();
    for (const Assets& assets : {Assets{add_shed_of_any_size, {2.4, 2.4}, 14, 26, 1400},
                                 {add_picnic_table, {1.1, 0.8}, 4, 24, 130},
                                 {add_boat, {2.4, 0.7}, 0.8, 4, 60},
                                 {add_bench, {1, 0.3}, 6, 14, 150},
                                 {add_sign, {0.2, 0.4}, 5, 26, 160},
                                 {add_cabinet, {0.9, 0.4}, 5, 26, 180},
                                 {add_fire_ring, {0.7, 0.7}, 10, 24, 220},
                                 {add_bollard, {0.2, 0.2}, 6, 13, 50},
                                 {add_boulder, {0.9, 0.9}, 0.5, 40, 70},
                                 {add_log, {2, 0.3}, 2, 45, 160},
                                 {add_lamp, {0.2, 0.2}, 6, 14, 260}})
      scatter(assets, 0, length_m_);
    scatter({add_pine, {1.1, 1.1}, 5, kForestDepth_m, 55}, -kMargin_m, length_m_ + kMargin_m);
    scatter({add_broadleaf_tree, {0.9, 0.9}, 3, kForestDepth_m, 130}, -kMargin_m, length_m_ + kMargin_m);
    scatter({add_bush, {0.5, 0.5}, 1, kForestDepth_m, 45}, -kMargin_m, length_m_ + kMargin_m);
    return std::move(scene_);
  }

 private:
  Isometry3d standing(const Footprint& f) const { return upright_pose(shore_.lift(f.centre), f.heading_rad); }

  void lay_trail() {
    const double length = uniform(rng_, 25, 40);
    const double phase = uniform(rng_, 0, 2 * std::numbers::pi);
    Points middle;
    for (double x = 0; x <= length_m_; ++x) {
      const double inland = kTrail_m + 1.5 * std::sin(2 * std::numbers::pi * x / length + phase);
      middle.push_back(shore_.lift(shore_.inland(x, inland)));
    }
    scene_.path = middle;
    for (double s = 0; s < path_length_m(middle); s += 1) {
      const PathPoint here = along_path(middle, s);
      plan_.take({here.position.head<2>(), here.heading_rad, {1, 1.9}});
    }
  }

  void string_power_line() {
    Points last;
    for (double x = -kMargin_m; x < length_m_ + kMargin_m; x += uniform(rng_, 22, 30)) {
      const Footprint spot{shore_.inland(x, 27 + uniform(rng_, -0.5, 0.5)), 0, {0.3, 0.3}};
      plan_.take(spot);
      const Points carriers = add_utility_pole(scene_.mesh, standing(spot), 8.5);
      if (!last.empty()) add_span(scene_.mesh, last, carriers);
      last = carriers;
    }
  }

  void build_jetties() {
    const int count = 1 + static_cast<int>(length_m_ / 70);
    for (int i = 0; i < count; ++i) {
      const double x = length_m_ * (i + uniform(rng_, 0.25, 0.75)) / count;
      const Vector2d landing = shore_.inland(x, 1);
      const double length = uniform(rng_, 6, 12);
      plan_.take({landing - Vector2d(0, length / 2), 0, {1.2, length / 2}});
      add_jetty(scene_.mesh, upright_pose({landing.x(), landing.y(), 0}, uniform(rng_, -0.2, 0.2)), length);
    }
  }

  /// A row between trail and forest, nose to the lake.
  void park_cars() {
    const double begin = length_m_ * uniform(rng_, 0.1, 0.5);
    for (double x = begin; x < begin + 24; x += 2.9) {
      if (uniform01(rng_) < 0.35) continue;
      const Footprint place{shore_.inland(x, 19.5 + uniform(rng_, -0.3, 0.3)),
                            -std::numbers::pi / 2 + uniform(rng_, -0.05, 0.05),
                            {2.5, 1}};
      if (!plan_.is_free(place, 0.1)) continue;
      plan_.take(place);
      (uniform01(rng_) < 0.2 ? add_van : add_car)(scene_.mesh, standing(place), rng_);
    }
  }

  void scatter(const Assets& assets, double begin_m, double end_m) {
    const double area = (end_m - begin_m) * (assets.farthest_m - assets.nearest_m);
    const int count = 1 + static_cast<int>(area / assets.area_m2);
    for (int i = 0; i < count; ++i) {
      const double x = uniform(rng_, begin_m, end_m);
      const double inland = uniform(rng_, assets.nearest_m, assets.farthest_m);
      const double heading = uniform(rng_, -std::numbers::pi, std::numbers::pi);
      const Footprint spot{shore_.inland(x, inland), heading, assets.half_size_m};
      if (!plan_.is_free(spot, 0.3)) continue;
      plan_.take(spot);
      assets.add(scene_.mesh, standing(spot), rng_);
    }
  }

  const double length_m_;
  Rng& rng_;
  const Shore shore_;
  SitePlan plan_;
  Scene scene_;
};

}  // namespace

void CanopyOptions::validate() const { require_length("canopy: length_m", length_m, 40, 2000); }

Scene make_canopy_scene(const CanopyOptions& options, Rng& rng) {
  options.validate();
  return Park(options, rng).build();
}

}  // namespace tcm_icp
