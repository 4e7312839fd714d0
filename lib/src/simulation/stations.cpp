#include "simulation/stations.hpp"

#include <array>
#include <numbers>

#include "simulation/draw.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/evaluation/overlap.hpp"

namespace tcm_icp {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d random_level_turn(double max_tilt_deg, Rng& rng) {
  const double heading = uniform(rng, -std::numbers::pi, std::numbers::pi);
  const double tilt = radians(max_tilt_deg) * uniform01(rng);
  const double axis = uniform(rng, 0, 2 * std::numbers::pi);
  return Isometry3d(Eigen::AngleAxisd(tilt, Vector3d(std::cos(axis), std::sin(axis), 0)) *
                    Eigen::AngleAxisd(heading, Vector3d::UnitZ()));
}

namespace {

double distance_along_path_m(const Scene& scene, const SceneSetOptions& options, int index) {
  const double length = path_length_m(scene.path);
  if (!options.overlap) return (index + 0.5) / options.num_scans * length;
  const double spacing = std::min(options.station_spacing_m, length / options.num_scans);
  return (length - options.num_scans * spacing) / 2 + (index + 0.5) * spacing;
}

/// Off the path's middle by as much as there is room. A tripod is levelled to half a degree and looks anywhere; a
/// platform looks ahead, sways by a few degrees of heading, and pitches and rolls as the ground does.
Isometry3d station_at(const Scene& scene, const SceneSetOptions& options, double distance_m, Rng& rng) {
  const PathPoint at = along_path(scene.path, distance_m);
  const double offset = uniform(rng, -scene.free_half_width_m, scene.free_half_width_m);
  const Vector3d left(-std::sin(at.heading_rad), std::cos(at.heading_rad), 0);
  const Vector3d position = at.position + offset * left + Vector3d(0, 0, options.scanner_height_m);
  const Isometry3d turn = random_level_turn(0.5, rng);
  if (options.scanner.sensor == SensorKind::kTerrestrial) return Eigen::Translation3d(position) * turn;
  const double sway = radians(uniform(rng, -3, 3));
  const double pitch = radians(uniform(rng, -2, 2));
  const double roll = radians(uniform(rng, -2, 2));
  return upright_pose(position, at.heading_rad + sway) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Vector3d::UnitX());
}

/// Compares scans at changing distances with one place of the path.
class OverlapProbe {
 public:
  OverlapProbe(const RayCaster& caster, const Scene& scene, const SceneSetOptions& options, double begin_m,
               std::uint64_t seed, int num_threads)
      : caster_(caster), scene_(scene), options_(options), begin_m_(begin_m), seed_(seed), threads_(num_threads) {
    first_ = scan_at(begin_m, "first");
  }

  double overlap_at(double distance_m) const {
    const Eigen::MatrixXd overlap = overlap_matrix({first_, scan_at(begin_m_ + distance_m, "second")}, threads_);
    return std::max(overlap(0, 1), overlap(1, 0));
  }

 private:
  /// As random as any station, but for one of a pair the same at every distance.
  Points scan_at(double distance_m, const char* which) const {
    Rng rng = make_stream(seed_, "overlap probe", which + std::to_string(begin_m_));
    const Isometry3d T_world_scanner = station_at(scene_, options_, distance_m, rng);
    const LidarScan scan = simulate_scan(caster_, T_world_scanner, options_.scanner, rng, threads_);
    return transformed(scan.cloud, T_world_scanner).points;
  }

  const RayCaster& caster_;
  const Scene& scene_;
  const SceneSetOptions& options_;
  const double begin_m_;
  const std::uint64_t seed_;
  const int threads_;
  Points first_;
};

}  // namespace

Isometry3d make_station(const Scene& scene, const SceneSetOptions& options, int index, Rng& rng) {
  return station_at(scene, options, distance_along_path_m(scene, options, index), rng);
}

double spacing_for_overlap(const Scene& scene, const SceneSetOptions& options, std::uint64_t seed, int num_threads) {
  constexpr int kSteps = 6;
  const RayCaster caster(scene.mesh);
  const double length = path_length_m(scene.path);
  std::vector<OverlapProbe> probes;
  for (const double share : {0.05, 0.25, 0.45, 0.65})
    probes.emplace_back(caster, scene, options, share * length, seed, num_threads);
  double near = 0, far = 0.35 * length;  // so that the last place's other end is on the path
  for (int step = 0; step < kSteps; ++step) {
    const double middle = (near + far) / 2;
    double sum = 0;
    for (const OverlapProbe& probe : probes) sum += probe.overlap_at(middle);
    (sum / static_cast<double>(probes.size()) > *options.overlap ? near : far) = middle;
  }
  return std::max(1.0, (near + far) / 2);
}

}  // namespace tcm_icp
