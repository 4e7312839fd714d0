#include "tcm_icp/simulation/lidar.hpp"

#include <cmath>
#include <string>
#include <unordered_set>

#include "simulation/draw.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

void require(bool holds, const char* field, double value, const char* bound) {
  if (!holds)
    throw InvalidOptions("scanner: " + std::string(field) + " = " + std::to_string(value) + "; needs " + bound);
}

Eigen::Vector3d ray_direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

class Dome {
 public:
  Dome(const RayCaster& scene, const Eigen::Isometry3d& T_world_scanner, const ScannerOptions& options)
      : scene_(scene), T_world_scanner_(T_world_scanner), options_(options) {}

  std::size_t num_azimuths() const { return static_cast<std::size_t>(std::lround(360 / options_.step_deg)); }
  std::size_t num_elevations() const {
    return 1 + static_cast<std::size_t>((options_.max_elevation_deg - options_.min_elevation_deg) / options_.step_deg);
  }

  LidarScan sweep(std::size_t azimuth, Rng& rng) const {
    LidarScan out;
    for (std::size_t row = 0; row < num_elevations(); ++row) shoot(azimuth, row, rng, out);
    return out;
  }

  /// A return somewhere between the scanner and what it looks at; false where the random ray has no room for one.
  bool shoot_into_air(Rng& rng, LidarScan& out) const {
    const double azimuth = 2 * std::numbers::pi * uniform01(rng);
    const double elevation = radians(uniform(rng, options_.min_elevation_deg, options_.max_elevation_deg));
    const double share = uniform01(rng);
    const Eigen::Vector3d direction = ray_direction(azimuth, elevation);
    const auto hit = cast(direction);
    const double free_range = hit ? hit->range_m : options_.max_range_m;
    if (free_range <= options_.min_range_m) return false;
    out.cloud.points.push_back((options_.min_range_m + share * (free_range - options_.min_range_m)) * direction);
    out.intensity.push_back(0);
    return true;
  }

 private:
  std::optional<RayHit> cast(const Eigen::Vector3d& direction) const {
    return scene_.first_hit(T_world_scanner_.translation(), T_world_scanner_.linear() * direction,
                            options_.max_range_m);
  }

  void shoot(std::size_t azimuth, std::size_t row, Rng& rng, LidarScan& out) const {
    const double azimuth_deg = 360.0 * static_cast<double>(azimuth) / static_cast<double>(num_azimuths());
    const double elevation_deg = options_.min_elevation_deg + options_.step_deg * static_cast<double>(row);
    // Always the same draws for a ray, whatever it hits: changing one surface leaves the other returns as they were.
    const double azimuth_error_deg = options_.angular_noise_deg * standard_normal(rng);
    const double elevation_error_deg = options_.angular_noise_deg * standard_normal(rng);
    const double range_error_m = options_.range_noise_m * standard_normal(rng);
    const double luck = uniform01(rng);

    const Eigen::Vector3d aimed =
        ray_direction(radians(azimuth_deg + azimuth_error_deg), radians(elevation_deg + elevation_error_deg));
    const auto hit = cast(aimed);
    if (!hit || hit->range_m < options_.min_range_m) return;
    const double signal = -hit->reflectivity * hit->normal.dot(T_world_scanner_.linear() * aimed);
    if (luck * options_.full_return_signal >= signal) return;
    out.cloud.points.push_back((hit->range_m + range_error_m) *
                               ray_direction(radians(azimuth_deg), radians(elevation_deg)));
    out.intensity.push_back(static_cast<float>(signal));
  }

  const RayCaster& scene_;
  const Eigen::Isometry3d T_world_scanner_;
  const ScannerOptions& options_;
};

LidarScan joined_and_thinned(const std::vector<LidarScan>& sweeps, double voxel_m) {
  LidarScan out;
  std::unordered_set<VoxelKey, VoxelKeyHash> taken;
  for (const auto& sweep : sweeps) {
    for (std::size_t i = 0; i < sweep.cloud.size(); ++i) {
      const auto& point = sweep.cloud.points[i];
      if (voxel_m > 0 && !taken.insert(voxel_key(point, voxel_m)).second) continue;
      out.cloud.points.push_back(point);
      out.intensity.push_back(sweep.intensity[i]);
    }
  }
  return out;
}

}  // namespace

void ScannerOptions::validate() const {
  require(step_deg >= 0.02 && step_deg <= 10, "step_deg", step_deg, "0.02..10");
  require(min_elevation_deg >= -90 && min_elevation_deg < max_elevation_deg, "min_elevation_deg", min_elevation_deg,
          "-90 <= min < max");
  require(max_elevation_deg <= 90, "max_elevation_deg", max_elevation_deg, "<= 90");
  require(min_range_m >= 0 && min_range_m < max_range_m, "min_range_m", min_range_m, "0 <= min < max");
  require(std::isfinite(max_range_m), "max_range_m", max_range_m, "a finite number");
  require(range_noise_m >= 0 && range_noise_m < max_range_m, "range_noise_m", range_noise_m,
          "0 <= noise < max_range_m");
  require(angular_noise_deg >= 0 && angular_noise_deg <= 10, "angular_noise_deg", angular_noise_deg, "0..10");
  require(full_return_signal > 0 && full_return_signal <= 1, "full_return_signal", full_return_signal,
          "0 < signal <= 1");
  require(thinning_voxel_m >= 0 && std::isfinite(thinning_voxel_m), "thinning_voxel_m", thinning_voxel_m, ">= 0");
  require(isolated_share >= 0 && isolated_share <= 0.5, "isolated_share", isolated_share, "0..0.5");
}

LidarScan simulate_scan(const RayCaster& scene, const Eigen::Isometry3d& T_world_scanner, const ScannerOptions& options,
                        Rng& rng, int num_threads) {
  options.validate();
  const Dome dome(scene, T_world_scanner, options);
  const std::uint64_t seed = rng();
  std::vector<LidarScan> sweeps(dome.num_azimuths());
  parallel_for(num_threads, sweeps.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Rng own = make_stream(seed, "lidar azimuth", std::to_string(i));
      sweeps[i] = dome.sweep(i, own);
    }
  });
  LidarScan scan = joined_and_thinned(sweeps, options.thinning_voxel_m);
  // Added after thinning, which would otherwise favour them: nothing else is in their voxels.
  const auto num_isolated = std::lround(options.isolated_share * static_cast<double>(scan.cloud.size()));
  Rng own = make_stream(seed, "isolated returns");
  for (long added = 0; added < num_isolated;) added += dome.shoot_into_air(own, scan) ? 1 : 0;
  return scan;
}

}  // namespace tcm_icp
