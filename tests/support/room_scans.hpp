#pragma once
// What scanners that turn see of the furnished room, with noise of their ranges.

#include "support/box_room.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp::testing {

inline Eigen::Vector3d spinner() { return {2.9, 2.4, 1.5}; }
inline Eigen::Quaterniond tilted() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 0).normalized()));
}

/// Of a scanner on a tripod: steps [degrees] around, and up from `lowest` to below `highest`.
inline Points rays_of_steps(const Eigen::Quaterniond& attitude, double around, double up, double lowest = -50,
                            double highest = 60) {
  Points rays;
  for (double elevation = lowest; elevation < highest; elevation += up) {
    for (double azimuth = 0; azimuth < 360; azimuth += around) {
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
