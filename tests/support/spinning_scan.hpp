#pragma once
// What a scanner that turns sees of the furnished room, with noise of its ranges.

#include "support/box_room.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp::testing {

inline Eigen::Vector3d spinner() { return {2.9, 2.4, 1.5}; }
inline Eigen::Quaterniond tilted() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 0).normalized()));
}

/// Equal steps of 0.6 degrees both ways, as of a scanner on a tripod; lines run around or up and down, as one likes.
inline Points rays_of_equal_steps(const Eigen::Quaterniond& attitude) {
  Points rays;
  for (double azimuth = 0; azimuth < 360; azimuth += 0.6) {
    for (double elevation = -50; elevation < 60; elevation += 0.6) {
      const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
      rays.push_back(attitude * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)));
    }
  }
  return rays;
}

/// Each point moved along its ray, by the noise's standard deviation [m].
inline Cloud with_range_noise(Cloud cloud, const Eigen::Vector3d& from, double noise_m) {
  Rng rng = make_stream(2, "spinning scan noise");
  for (auto& p : cloud.points) p += noise_m * standard_normal(rng) * (p - from).normalized();
  return cloud;
}

inline Cloud spinning_scan(double noise_m = 0, const Eigen::Vector3d& from = spinner(),
                           const Eigen::Quaterniond& attitude = tilted()) {
  return with_range_noise(scan_room(furnished_room(), from, rays_of_spinning_scanner(attitude)), from, noise_m);
}

}  // namespace tcm_icp::testing
