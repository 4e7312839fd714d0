// A motorway: rails on posts, a wall of equal panels, lamps; what differs from place to place stands beyond.

#include <numbers>

#include "simulation/arc.hpp"
#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/ground.hpp"
#include "simulation/require_length.hpp"
#include "simulation/town_objects.hpp"
#include "simulation/tree.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kRoadBeyond_m = 100;  // the road goes on beyond both ends of the way
constexpr double kPanel_m = 4;         // of the wall, from post to post
constexpr double kVerge_m = 40;        // from the middle to where the ground ends
constexpr double kRail = 0.6;          // reflectivity
constexpr double kTreeSpacing_m = 7;   // on average, along the verge that has no wall
constexpr double kLane_m = 3.75;       // width

class MotorwayBuilder {
 public:
  MotorwayBuilder(double length_m, Rng& rng)
      : rng_(rng),
        ground_(rng),
        length_m_(length_m),
        middle_(random_arc(600, 0, rng)),
        half_road_m_(kLane_m * static_cast<int>(uniform(rng, 3, 4.999))),
        post_m_(uniform01(rng) < 0.5 ? 2 : 4),
        wall_m_(uniform(rng, 2.5, 5)),
        lamp_m_(uniform(rng, 35, 60)) {}

  Scene build() {
    const double lane = 0.5 * half_road_m_;
    for (double x = 0; x <= length_m_; ++x) scene_.path.push_back(on_ground(x, -lane).translation());
    scene_.free_half_width_m = 1.5;
    Points all;
    for (double x = -kRoadBeyond_m; x <= length_m_ + kRoadBeyond_m; x += 4)
      all.push_back(on_ground(x, 0).translation());
    ground_.add_along(scene_.mesh, all, kVerge_m);
    for (const double left : {-half_road_m_, 0.0, half_road_m_}) lay_rail(left);
    build_wall();
    light();
    span_gantries();
    plant();
    put_odds_and_ends();
    return std::move(scene_);
  }

 private:
  Isometry3d on_ground(double along_m, double left_m) const {
    Isometry3d out = middle_.at(along_m, left_m);
    out.translation().z() = ground_.height_m(out.translation().head<2>());
    return out;
  }

  double end_m() const { return length_m_ + kRoadBeyond_m; }

  /// A strip along the road from `low_m` to `high_m` above the ground.
  void add_strip(double begin_m, double step_m, double left_m, double low_m, double high_m, double reflectivity) {
    const Vector3d from = on_ground(begin_m, left_m).translation();
    const Vector3d to = on_ground(begin_m + step_m, left_m).translation();
    const Vector3d low(0, 0, low_m), high(0, 0, high_m);
    add_quad(scene_.mesh, from + low, to + low, to + high, from + high, reflectivity);
  }

  void lay_rail(double left_m) {
    for (double x = -kRoadBeyond_m; x < end_m(); x += post_m_) {
      add_strip(x, post_m_, left_m, 0.45, 0.75, kRail);
      add_box(scene_.mesh, on_ground(x, left_m), box(-0.05, 0.05, 0, 0.1, -kObjectFooting_m, 0.7), kRail);
    }
  }

  void build_wall() {
    const double left = half_road_m_ + 2;
    for (double x = -kRoadBeyond_m; x < end_m(); x += kPanel_m) {
      add_strip(x, kPanel_m, left, -kObjectFooting_m, wall_m_, kConcrete);
      add_box(scene_.mesh, on_ground(x, left), box(-0.1, 0.1, -0.15, 0.1, -kObjectFooting_m, wall_m_ + 0.2), kRail);
    }
  }

  void light() {
    const double begin = -kRoadBeyond_m + uniform(rng_, 0, lamp_m_);
    for (double x = begin; x < end_m(); x += lamp_m_) add_lamp(scene_.mesh, on_ground(x, -half_road_m_ - 1.5), rng_);
  }

  /// Signs over the road, and the frames that carry them.
  void span_gantries() {
    for (double x = -kRoadBeyond_m + uniform(rng_, 0, 120); x < end_m(); x += uniform(rng_, 90, 220)) {
      const Isometry3d T = on_ground(x, 0);
      const double y = half_road_m_ + 1, sign = uniform(rng_, 2, 0.8 * half_road_m_);
      for (const double side : {-y, 0.7})
        add_box(scene_.mesh, T, box(-0.15, 0.15, side - 0.15, side + 0.15, -kObjectFooting_m, 7), kRail);
      add_box(scene_.mesh, T, box(-0.2, 0.2, -y, 0.85, 6.6, 7), kRail);
      add_box(scene_.mesh, T, box(-0.3, -0.2, -y + 0.5, -y + 0.5 + sign, 5.2, 7.4), 0.9);
    }
  }

  void plant() {
    for (double x = -kRoadBeyond_m; x < end_m(); x += uniform(rng_, 0.2, 1.8) * kTreeSpacing_m) {
      const double left = -half_road_m_ - uniform(rng_, 4, 24);
      const double heading = uniform(rng_, 0, 2 * std::numbers::pi);
      const Isometry3d T = upright_pose(on_ground(x, left).translation(), heading);
      const double kind = uniform01(rng_);
      if (kind < 0.35)
        add_bush(scene_.mesh, T, rng_);
      else if (kind < 0.7)
        add_tree(scene_.mesh, T, rng_);
      else
        add_broadleaf_tree(scene_.mesh, T, rng_);
    }
  }

  /// Marker posts every 50 m; cabinets and heaps where they happen to be; a car that has broken down.
  void put_odds_and_ends() {
    for (double x = -kRoadBeyond_m; x < end_m(); x += 50)
      add_box(scene_.mesh, on_ground(x, -half_road_m_ - 0.6), box(-0.06, 0.06, -0.06, 0.06, -kObjectFooting_m, 1), 0.9);
    for (double x = -kRoadBeyond_m; x < end_m(); x += uniform(rng_, 15, 90)) {
      const double left = -half_road_m_ - uniform(rng_, 1.5, 3), half = uniform(rng_, 0.2, 0.9);
      const double top = uniform(rng_, 0.5, 1.8);
      add_box(scene_.mesh, on_ground(x, left), box(-half, half, -0.3, 0.3, -kObjectFooting_m, top), kPlaster);
    }
    const double at = uniform(rng_, 0, length_m_);
    add_car(scene_.mesh, on_ground(at, -half_road_m_ + 1.2), rng_);
  }

  Rng& rng_;
  const Ground ground_;
  const double length_m_;
  const Arc middle_;
  const double half_road_m_;
  const double post_m_, wall_m_, lamp_m_;  ///< from post to post, the wall's height, from lamp to lamp
  Scene scene_;
};

}  // namespace

void MotorwayOptions::validate() const { require_length("motorway: length_m", length_m, 40, 2000); }

Scene make_motorway_scene(const MotorwayOptions& options, Rng& rng) {
  options.validate();
  return MotorwayBuilder(options.length_m, rng).build();
}

}  // namespace tcm_icp
