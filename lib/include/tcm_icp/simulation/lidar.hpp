#pragma once
// A terrestrial scanner: a dome of rays, with the errors of a real one.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"

namespace tcm_icp {

struct ScannerOptions {
  double step_deg = 0.4;            ///< [deg] 0.02..10, between neighbouring rays, both in azimuth and elevation
  double min_elevation_deg = -60;   ///< [deg] -90 <= min < max <= 90; below it the tripod is in the way
  double max_elevation_deg = 70;    ///< [deg]
  double min_range_m = 0.6;         ///< [m] >= 0; nearer surfaces give no return
  double max_range_m = 80;          ///< [m] > min_range_m
  double range_noise_m = 0.005;     ///< [m] >= 0, standard deviation along the ray
  double angular_noise_deg = 0.01;  ///< [deg] >= 0, standard deviation of a ray's true direction about the recorded one
  double full_return_signal = 0.1;  ///< > 0; reflectivity times cosine of incidence from which a return is certain;
                                    ///< below it the chance falls in proportion (glass, grazing incidence)
  double thinning_voxel_m = 0.15;   ///< [m] >= 0; of each voxel's returns the first is kept; 0 keeps all
  double isolated_share = 0.002;    ///< 0..0.5, returns in mid air (dust, birds, rain) as a share of the kept ones
  void validate() const;            ///< throws InvalidOptions
};

/// Returns in the scanner's frame: origin in the scanner, z up. Normals are empty.
struct LidarScan {
  Cloud cloud;
  std::vector<float> intensity;  ///< 0..1, reflectivity times cosine of incidence; 0 for returns in mid air
};

/// One scan. Each azimuth draws from its own random stream, so the number of threads never changes the result.
/// @throws InvalidOptions
/// Cost: (360 / step) * (elevation range / step) rays.
LidarScan simulate_scan(const RayCaster& scene, const Eigen::Isometry3d& T_world_scanner, const ScannerOptions& options,
                        Rng& rng, int num_threads);

}  // namespace tcm_icp
