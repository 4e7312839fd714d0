// A tunnel: its rings, lamps and niches repeat, so that a scan looks like any other some rings farther.

#include <cmath>
#include <numbers>
#include <vector>

#include "simulation/arc.hpp"
#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/require_length.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kTunnelBeyond_m = 60;  // the tunnel goes on beyond both ends of the way
constexpr int kSegments = 24;           // of a ring, from one edge of the floor over the crown to the other
constexpr double kJoint_m = 0.05;       // width and depth of the joint between rings
constexpr double kUneven_m = 0.006;     // how far a segment stands out of its ring or behind it
constexpr double kKerb_m = 0.15;        // height
constexpr double kWalkway_m = 0.7;      // width
constexpr double kLeftBehind = 0.12;    // things lying about, for a metre of the way
constexpr double kLining = kConcrete;   // reflectivity
constexpr double kAsphalt = 0.25;

class TunnelBuilder {
 public:
  TunnelBuilder(double length_m, Rng& rng)
      : rng_(rng),
        length_m_(length_m),
        axis_(random_arc(300, 0.03, rng)),
        radius_m_(uniform(rng, 2.8, 4.8)),
        centre_m_(uniform(rng, 0.3, 0.45) * radius_m_),
        ring_m_(uniform(rng, 1.2, 2)),
        lamp_rings_(static_cast<int>(uniform(rng, 4, 9))),
        niche_rings_(static_cast<int>(uniform(rng, 8, 17))) {}

  Scene build() {
    for (double x = 0; x <= length_m_; ++x) scene_.path.push_back(axis_.at(x).translation());
    scene_.free_half_width_m = half_floor_m() - kWalkway_m - 1;
    const int first = static_cast<int>(-kTunnelBeyond_m / ring_m_),
              end = static_cast<int>((length_m_ + kTunnelBeyond_m) / ring_m_);
    for (int ring = first; ring < end; ++ring) {
      line(ring * ring_m_);
      pave(ring * ring_m_);
      furnish(ring);
    }
    return std::move(scene_);
  }

 private:
  double half_floor_m() const { return std::sqrt(radius_m_ * radius_m_ - centre_m_ * centre_m_); }

  /// A corner of a segment: the `k`th of its ring, `beyond_m` outside of the lining.
  struct Corner {
    double along_m;
    int k;
    double beyond_m;
  };

  Vector3d at(const Corner& c) const {
    const double edge = -std::asin(centre_m_ / radius_m_);
    const double angle = edge + (std::numbers::pi - 2 * edge) * c.k / kSegments;
    const double r = radius_m_ + c.beyond_m;
    return axis_.at(c.along_m) * Vector3d(0, r * std::cos(angle), centre_m_ + r * std::sin(angle));
  }

  void line(double begin_m) {
    const double joint = begin_m + ring_m_ - kJoint_m, end = begin_m + ring_m_;
    for (int k = 0; k < kSegments; ++k) {
      const double beyond = uniform(rng_, -kUneven_m, kUneven_m);
      add_lining({begin_m, k, beyond}, {joint, k + 1, beyond});
      add_lining({joint, k, kJoint_m}, {end, k + 1, kJoint_m});
      // What closes the steps between segments, and the sides of the joint.
      add_step({begin_m, k, -kUneven_m}, {end, k, kJoint_m});
      add_step({joint, k, -kUneven_m}, {joint, k + 1, kJoint_m});
      add_step({end, k, -kUneven_m}, {end, k + 1, kJoint_m});
    }
  }

  void add_lining(const Corner& a, const Corner& b) {
    add_quad(scene_.mesh, at(a), at({b.along_m, a.k, a.beyond_m}), at(b), at({a.along_m, b.k, b.beyond_m}), kLining);
  }

  void add_step(const Corner& a, const Corner& b) {
    add_quad(scene_.mesh, at(a), at({b.along_m, b.k, a.beyond_m}), at(b), at({a.along_m, a.k, b.beyond_m}), kLining);
  }

  void pave(double begin_m) {
    const Isometry3d from = axis_.at(begin_m), to = axis_.at(begin_m + ring_m_);
    const auto strip = [&](const Vector3d& right, const Vector3d& left, double reflectivity) {
      add_quad(scene_.mesh, from * right, to * right, to * left, from * left, reflectivity);
    };
    const double wall = half_floor_m(), kerb = wall - kWalkway_m;
    strip({0, -kerb, 0}, {0, kerb, 0}, kAsphalt);
    for (const double side : {-1.0, 1.0}) {
      strip({0, side * kerb, 0}, {0, side * kerb, kKerb_m}, kConcrete);
      strip({0, side * kerb, kKerb_m}, {0, side * wall, kKerb_m}, kConcrete);
    }
    for (int pipe = 0; pipe < 3; ++pipe) {  // along the left wall, a hand's breadth before it
      const double z = centre_m_ + 0.5 + 0.25 * pipe, y = std::sqrt(radius_m_ * radius_m_ - 0.6 * 0.6) - 0.25;
      strip({0, y, z - 0.05}, {0, y, z + 0.05}, 0.6);
      strip({0, y - 0.04, z}, {0, y + 0.08, z}, 0.6);
    }
  }

  void furnish(int ring) {
    const Isometry3d at = axis_.at((ring + 0.5) * ring_m_);
    const double wall = half_floor_m(), crown = centre_m_ + radius_m_;
    if (ring % lamp_rings_ == 0) add_box(scene_.mesh, at, box(-0.6, 0.6, -0.12, 0.12, crown - 0.35, crown - 0.2), 0.7);
    if (ring % niche_rings_ == 0) {  // a cabinet before the right wall, and a sign over it
      add_box(scene_.mesh, at, box(-0.4, 0.4, -wall, -wall + 0.4, 0, 1.5), 0.6);
      add_box(scene_.mesh, at, box(-0.3, 0.3, -wall + 0.1, -wall + 0.15, 1.8, 2.3), 0.8);
    }
    if (uniform01(rng_) > kLeftBehind * ring_m_) return;
    const double side = uniform01(rng_) < 0.5 ? -1 : 1, half_m = uniform(rng_, 0.1, 0.6);
    const double depth = uniform(rng_, 0.2, 0.5), top = uniform(rng_, 0.3, 1.3);
    const double near = side * (wall - 0.1 - depth), far = side * (wall - 0.1);
    add_box(scene_.mesh, at, box(-half_m, half_m, std::min(near, far), std::max(near, far), kKerb_m, top), kPlaster);
  }

  Rng& rng_;
  const double length_m_;
  const Arc axis_;
  const double radius_m_, centre_m_;  ///< of the lining, and how high its middle lies above the road
  const double ring_m_;
  const int lamp_rings_, niche_rings_;  ///< from one to the next
  Scene scene_;
};

}  // namespace

void TunnelOptions::validate() const { require_length("tunnel: length_m", length_m, 40, 2000); }

Scene make_tunnel_scene(const TunnelOptions& options, Rng& rng) {
  options.validate();
  return TunnelBuilder(options.length_m, rng).build();
}

}  // namespace tcm_icp
