#pragma once
// Which way a scanner looks, and from where, ray by ray.

#include <Eigen/Geometry>
#include <cstddef>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/scanner_options.hpp"

namespace tcm_icp {

/// A ray's two angles: azimuth and elevation, or, of an aerial scanner, ahead and across from straight down.
struct RayAngles {
  double first_deg = 0, second_deg = 0;
};

/// Rays in sweeps, each of which is taken at one moment.
class ScanPattern {
 public:
  explicit ScanPattern(const ScannerOptions& options) : options_(options) {}

  std::size_t num_sweeps() const;
  std::size_t num_rays() const;  ///< of a sweep

  RayAngles angles(std::size_t sweep, std::size_t ray) const;
  Eigen::Vector3d direction(const RayAngles& angles) const;  ///< unit, in the frame of the sweep
  Eigen::Vector3d random_direction(Rng& rng) const;          ///< likewise, among those the scanner looks into

  /// Where the sweep was taken, in the scan's frame, and where its returns are recorded as if it had been.
  Eigen::Isometry3d T_scan_sweep(std::size_t sweep) const;
  Eigen::Isometry3d T_scan_recorded(std::size_t sweep) const;

 private:
  bool is_aerial() const { return options_.sensor == SensorKind::kAerial; }

  const ScannerOptions& options_;
};

}  // namespace tcm_icp
