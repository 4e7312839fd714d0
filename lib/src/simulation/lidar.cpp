#include "tcm_icp/simulation/lidar.hpp"

#include <cmath>
#include <string>
#include <unordered_set>

#include "simulation/draw.hpp"
#include "simulation/scan_pattern.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Returns of surfaces nearer to one another than half the length of a pulse (5 ns of light) are one return.
constexpr double kPulse_m = 0.75;

/// What may befall one ray. Always the same draws, whatever it hits: changing one surface, or one effect, leaves the
/// other returns as they were.
struct RayErrors {
  RayAngles angles;
  double range_m = 0;
  double luck = 0;
  double dropout_luck = 0;
  double beam_side_rad = 0;
  double mixture = 0;

  RayErrors(const ScannerOptions& options, Rng& rng, Rng& effects) {
    angles.first_deg = options.angular_noise_deg * standard_normal(rng);
    angles.second_deg = options.angular_noise_deg * standard_normal(rng);
    range_m = options.range_noise_m * standard_normal(rng);
    luck = uniform01(rng);
    dropout_luck = uniform01(effects);
    beam_side_rad = 2 * std::numbers::pi * uniform01(effects);
    mixture = uniform01(effects);
  }
};

/// A scanner at one place of the scene.
class Scanner {
 public:
  Scanner(const RayCaster& scene, const Isometry3d& T_world_scan, const ScannerOptions& options)
      : scene_(scene), T_world_scan_(T_world_scan), options_(options), pattern_(options) {
    min_cosine_ = options.max_incidence_deg < 90 ? std::cos(radians(options.max_incidence_deg)) : 0;
  }

  std::size_t num_sweeps() const { return pattern_.num_sweeps(); }

  LidarScan sweep(std::size_t index, Rng& rng, Rng& effects) const {
    LidarScan out;
    const Isometry3d T_world_sweep = T_world_scan_ * pattern_.T_scan_sweep(index);
    const Isometry3d T_scan_recorded = pattern_.T_scan_recorded(index);
    for (std::size_t ray = 0; ray < pattern_.num_rays(); ++ray) {
      const RayAngles angles = pattern_.angles(index, ray);
      const RayErrors errors(options_, rng, effects);
      shoot(T_world_sweep, T_scan_recorded, angles, errors, out);
    }
    return out;
  }

  /// A return somewhere between the scanner and what it looks at; false where the random ray has no room for one.
  bool shoot_into_air(Rng& rng, LidarScan& out) const {
    const Vector3d direction = pattern_.random_direction(rng);
    const double share = uniform01(rng);
    const std::size_t sweep = options_.sensor == SensorKind::kAerial ? uniform_index(rng, num_sweeps()) : 0;
    const Isometry3d T_scan_sweep = pattern_.T_scan_recorded(sweep);
    const auto hit = cast(T_world_scan_ * T_scan_sweep, direction);
    const double free_range = hit ? hit->range_m : options_.max_range_m;
    if (free_range <= options_.min_range_m) return false;
    out.cloud.points.push_back(T_scan_sweep *
                               ((options_.min_range_m + share * (free_range - options_.min_range_m)) * direction));
    out.intensity.push_back(0);
    return true;
  }

 private:
  std::optional<RayHit> cast(const Isometry3d& T_world_sweep, const Vector3d& direction) const {
    return scene_.first_hit(T_world_sweep.translation(), T_world_sweep.linear() * direction, options_.max_range_m);
  }

  void shoot(const Isometry3d& T_world_sweep, const Isometry3d& T_scan_recorded, const RayAngles& angles,
             const RayErrors& errors, LidarScan& out) const {
    const RayAngles aimed_angles{angles.first_deg + errors.angles.first_deg,
                                 angles.second_deg + errors.angles.second_deg};
    const Vector3d aimed = pattern_.direction(aimed_angles);
    const auto hit = cast(T_world_sweep, aimed);
    if (!hit || hit->range_m < options_.min_range_m || errors.dropout_luck < options_.dropout_share) return;
    const double cosine = -hit->normal.dot(T_world_sweep.linear() * aimed);
    const double signal = hit->reflectivity * cosine;
    if (cosine < min_cosine_ || errors.luck * options_.full_return_signal >= signal) return;
    const double range_m = mixed_range_m(T_world_sweep, aimed_angles, hit->range_m, errors) + errors.range_m;
    out.cloud.points.push_back(T_scan_recorded * (range_m * pattern_.direction(angles)));
    out.intensity.push_back(static_cast<float>(signal));
  }

  /// What the middle of the beam met, mixed with what a place on its rim did.
  double mixed_range_m(const Isometry3d& T_world_sweep, RayAngles angles, double range_m,
                       const RayErrors& errors) const {
    if (options_.beam_width_deg == 0) return range_m;
    angles.first_deg += options_.beam_width_deg / 2 * std::cos(errors.beam_side_rad);
    angles.second_deg += options_.beam_width_deg / 2 * std::sin(errors.beam_side_rad);
    const auto rim = cast(T_world_sweep, pattern_.direction(angles));
    if (!rim || std::abs(rim->range_m - range_m) > kPulse_m) return range_m;
    return range_m + errors.mixture * (rim->range_m - range_m);
  }

  const RayCaster& scene_;
  const Isometry3d T_world_scan_;
  const ScannerOptions& options_;
  const ScanPattern pattern_;
  double min_cosine_ = 0;
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

LidarScan simulate_scan(const RayCaster& scene, const Isometry3d& T_world_scanner, const ScannerOptions& options,
                        Rng& rng, int num_threads) {
  options.validate();
  const Scanner scanner(scene, T_world_scanner, options);
  const std::uint64_t seed = rng();
  std::vector<LidarScan> sweeps(scanner.num_sweeps());
  parallel_for(num_threads, sweeps.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Rng own = make_stream(seed, "lidar azimuth", std::to_string(i));
      Rng effects = make_stream(seed, "lidar effects", std::to_string(i));
      sweeps[i] = scanner.sweep(i, own, effects);
    }
  });
  LidarScan scan = joined_and_thinned(sweeps, options.thinning_voxel_m);
  // Added after thinning, which would otherwise favour them: nothing else is in their voxels.
  const auto num_isolated = std::lround(options.isolated_share * static_cast<double>(scan.cloud.size()));
  Rng own = make_stream(seed, "isolated returns");
  for (long added = 0; added < num_isolated;) added += scanner.shoot_into_air(own, scan) ? 1 : 0;
  return scan;
}

}  // namespace tcm_icp
