#pragma once
// Small random draws of the simulation. Each draw is a statement of its own where it is used: the order in which a
// compiler evaluates arguments is open, and would change the scene.

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

inline double uniform(Rng& rng, double low, double high) { return low + (high - low) * uniform01(rng); }

/// Uniform on the unit sphere.
inline Eigen::Vector3d uniform_direction(Rng& rng) {
  const double z = uniform(rng, -1, 1);
  const double angle = uniform(rng, 0, 2 * std::numbers::pi);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

inline Eigen::Isometry3d upright_pose(const Eigen::Vector3d& position, double heading_rad) {
  return Eigen::Translation3d(position) * Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ());
}

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace tcm_icp
