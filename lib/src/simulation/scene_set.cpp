#include "tcm_icp/simulation/scene_set.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "simulation/draw.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/evaluation/overlap.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

void require(bool holds, const std::string& field, double value, const std::string& bound) {
  if (!holds) throw InvalidOptions("simulate: " + field + " = " + std::to_string(value) + "; needs " + bound);
}

std::string file_name(int index) {
  char name[32];
  std::snprintf(name, sizeof name, "%03d.ply", index);
  return name;
}

/// A turn to any heading after a tilt of up to `max_tilt_deg` about a level axis.
Isometry3d random_level_turn(double max_tilt_deg, Rng& rng) {
  const double heading = uniform(rng, -std::numbers::pi, std::numbers::pi);
  const double tilt = radians(max_tilt_deg) * uniform01(rng);
  const double axis = uniform(rng, 0, 2 * std::numbers::pi);
  return Isometry3d(Eigen::AngleAxisd(tilt, Vector3d(std::cos(axis), std::sin(axis), 0)) *
                    Eigen::AngleAxisd(heading, Vector3d::UnitZ()));
}

/// Evenly along the path, off its middle by up to 1.2 m; a surveyor levels the tripod to within half a degree.
Isometry3d station(const Scene& scene, const SceneSetOptions& options, int index, Rng& rng) {
  const double share = (index + 0.5) / options.num_scans;
  const PathPoint at = along_path(scene.path, share * path_length_m(scene.path));
  const double offset = uniform(rng, -1.2, 1.2);
  const Vector3d left(-std::sin(at.heading_rad), std::cos(at.heading_rad), 0);
  return Eigen::Translation3d(at.position + offset * left + Vector3d(0, 0, options.scanner_height_m)) *
         random_level_turn(0.5, rng);
}

Isometry3d random_frame(const SceneSetOptions& options, Rng& rng) {
  const Isometry3d turn = random_level_turn(options.max_tilt_deg, rng);
  const double shift = options.max_shift_m * std::sqrt(uniform01(rng));
  const double direction = uniform(rng, 0, 2 * std::numbers::pi);
  const double rise = 0.1 * options.max_shift_m * uniform(rng, -1, 1);
  return Eigen::Translation3d(shift * std::cos(direction), shift * std::sin(direction), rise) * turn;
}

Vector3d mean_of(const Points& points) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& p : points) sum += p;
  return points.empty() ? sum : Vector3d(sum / static_cast<double>(points.size()));
}

Scene make_scene(const SceneSetOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "scene");
  switch (options.scene) {
    case SceneKind::kTown:
      return make_town_scene(options.town, rng);
    case SceneKind::kBlock:
      // No shorter than leaves room for a building inside.
      return make_block_scene({std::max(140.0, options.num_scans * options.station_spacing_m)}, rng);
    case SceneKind::kStreet:
      return make_street_scene({std::max(40.0, options.num_scans * options.station_spacing_m)}, rng);
  }
  throw InvalidOptions("simulate: unknown scene");
}

/// Scan `index` and its truth. Each scan draws from its own stream: the others do not depend on it.
void add_scan(SceneSet& set, const RayCaster& caster, int index, int num_threads) {
  const std::string file = file_name(index);
  Rng rng = make_stream(set.seed, "scan", file);
  const Isometry3d T_world_scanner = station(set.scene, set.options, index, rng);
  const Isometry3d T_scan_scanner = random_frame(set.options, rng);
  LidarScan scan = simulate_scan(caster, T_world_scanner, set.options.scanner, rng, num_threads);
  if (scan.cloud.empty())
    throw InvalidOptions("simulate: scan " + file + " has no returns; needs a farther max_range_m");
  scan.cloud = transformed(scan.cloud, T_scan_scanner);
  const Isometry3d T_world_scan = T_world_scanner * T_scan_scanner.inverse();
  if (set.options.initial_guess) {
    Rng guess_rng = make_stream(set.seed, "initial guess", file);
    const Vector3d centre = T_world_scan * mean_of(scan.cloud.points);
    set.initial_guess.push_back(index == 0 ? T_world_scan
                                           : perturb_pose(T_world_scan, centre, *set.options.initial_guess, guess_rng));
  }
  set.truth.scans.push_back({file, T_world_scan, 0});
  set.scanner_in_scan.push_back(T_scan_scanner.translation());
  set.scans.push_back(std::move(scan));
}

}  // namespace

SceneKind scene_kind_from_name(const std::string& name) {
  for (const SceneKind kind : {SceneKind::kTown, SceneKind::kBlock, SceneKind::kStreet})
    if (name == scene_name(kind)) return kind;
  throw InvalidOptions("scene '" + name + "' is not known; there are: town, block, street");
}

std::string scene_name(SceneKind kind) {
  switch (kind) {
    case SceneKind::kTown:
      return "town";
    case SceneKind::kBlock:
      return "block";
    case SceneKind::kStreet:
      return "street";
  }
  throw InvalidOptions("simulate: unknown scene");
}

SceneSetOptions default_scene_set(SceneKind kind) {
  SceneSetOptions options;
  options.scene = kind;
  if (kind == SceneKind::kTown) return options;
  options.scanner.max_range_m = 40;
  options.scanner.thinning_voxel_m = 0.2;
  options.num_scans = kind == SceneKind::kBlock ? 20 : 60;
  options.station_spacing_m = 14;
  // Measured on 36 scans of a street, registered one after another: 0.22 m at the far end of 500 m. A loop closes.
  options.drift_share = kind == SceneKind::kBlock ? 2.5e-4 : 5e-4;
  return options;
}

void SceneSetOptions::validate() const {
  town.validate();
  scanner.validate();
  if (initial_guess) initial_guess->validate();
  require(num_scans >= 1 && num_scans <= 1000, "num_scans", num_scans, "1..1000");
  require(station_spacing_m >= 1 && station_spacing_m <= 100, "station_spacing_m", station_spacing_m, "1..100");
  require(scanner_height_m > 0 && std::isfinite(scanner_height_m), "scanner_height_m", scanner_height_m, "> 0");
  require(drift_share >= 0 && drift_share <= 0.01, "drift_share", drift_share, "0..0.01");
  require(max_tilt_deg >= 0 && max_tilt_deg <= 90, "max_tilt_deg", max_tilt_deg, "0..90");
  require(max_shift_m >= 0 && std::isfinite(max_shift_m), "max_shift_m", max_shift_m, ">= 0");
}

SceneSet simulate_scene_set(const SceneSetOptions& options, const RunContext& context) {
  options.validate();
  SceneSet set;
  set.options = options;
  set.seed = context.seed;
  set.scene = make_scene(options, context.seed);
  set.truth.tolerance = options.tolerance;
  set.truth.tolerance.rmse_m += options.drift_share * path_length_m(set.scene.path);
  const RayCaster caster(set.scene.mesh);
  for (int i = 0; i < options.num_scans; ++i) {
    context.report("simulate", static_cast<std::size_t>(i), static_cast<std::size_t>(options.num_scans));
    add_scan(set, caster, i, context.num_threads);
  }
  std::vector<Points> in_world;
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    in_world.push_back(transformed(set.scans[i].cloud, set.truth.scans[i].T_world_scan).points);
  }
  set.truth.overlap = overlap_matrix(in_world, context.num_threads);
  return set;
}

}  // namespace tcm_icp
