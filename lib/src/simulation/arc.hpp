#pragma once
// A way of constant curvature and slope, as tunnels and motorways have.

#include <Eigen/Geometry>
#include <cmath>

#include "simulation/draw.hpp"

namespace tcm_icp {

class Arc {
 public:
  /// @param curvature_per_m  of the way on the map; to the left where positive
  Arc(double curvature_per_m, double slope) : curvature_(curvature_per_m), slope_(slope) {}

  /// The pose of a frame whose x leads along the way and whose z is up, `distance_m` along it (may be negative) and
  /// `left_m` to the left of it.
  Eigen::Isometry3d at(double distance_m, double left_m = 0) const {
    const double turn = curvature_ * distance_m;
    const double share = std::abs(turn) < 1e-6 ? 1 : std::sin(turn / 2) / (turn / 2);
    const Eigen::Vector3d chord =
        share * distance_m * Eigen::Vector3d(std::cos(turn / 2), std::sin(turn / 2), 0) +
        Eigen::Vector3d(-left_m * std::sin(turn), left_m * std::cos(turn), slope_ * distance_m);
    return upright_pose(chord, turn);
  }

 private:
  double curvature_, slope_;
};

/// As tight as `least_radius_m` to either side, or less.
inline Arc random_arc(double least_radius_m, double most_slope, Rng& rng) {
  const double curvature = uniform(rng, -1, 1) / least_radius_m;
  const double slope = uniform(rng, -most_slope, most_slope);
  return {curvature, slope};
}

}  // namespace tcm_icp
