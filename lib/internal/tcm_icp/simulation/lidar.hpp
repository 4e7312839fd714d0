#pragma once
// A scan of a made-up scene, with the errors of a real one.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"
#include "tcm_icp/simulation/scanner_options.hpp"

namespace tcm_icp {

/// Returns in the scanner's frame: origin in the scanner (of an aerial one, and of one that moves, in the middle of its
/// way), z up, x ahead where it moves. Normals are empty.
struct LidarScan {
  Cloud cloud;
  std::vector<float> intensity;  ///< 0..1, reflectivity times cosine of incidence; 0 for returns in mid air
};

/// One scan. Each sweep (an azimuth, or a line of an aerial scanner) draws from its own random streams, so the number
/// of threads never changes the result.
/// @throws InvalidOptions
/// Cost: one ray a direction, two where beam_width_deg is not 0.
LidarScan simulate_scan(const RayCaster& scene, const Eigen::Isometry3d& T_world_scanner, const ScannerOptions& options,
                        Rng& rng, int num_threads);

}  // namespace tcm_icp
