#include "tcm_icp/simulation/scene_set.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "simulation/draw.hpp"
#include "simulation/stations.hpp"
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

/// The way leads along each corridor twice but for the first and the last, into two rooms of each, and up the stairs.
double corridor_length_m(int storeys, double path_m) {
  constexpr double kRooms_m = 4, kStairs_m = 11;
  return (path_m - storeys * kRooms_m - (storeys - 1) * kStairs_m) / (2 * storeys - 2);
}

Scene make_scene(const SceneSetOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "scene");
  const double needed_m = options.num_scans * options.station_spacing_m;
  switch (options.scene) {
    case SceneKind::kTown:
      return make_town_scene(options.town, rng);
    case SceneKind::kBlock:
      // No shorter than leaves room for a building inside.
      return make_block_scene({std::max(140.0, needed_m)}, rng);
    case SceneKind::kStreet:
      return make_street_scene({std::max(40.0, needed_m)}, rng);
    case SceneKind::kUrban:
      return make_urban_scene({std::max(40.0, needed_m)}, rng);
    case SceneKind::kCanopy:
      return make_canopy_scene({std::max(40.0, needed_m)}, rng);
    case SceneKind::kOrchard:
      return make_orchard_scene({std::max(40.0, needed_m)}, rng);
    case SceneKind::kTunnel:
      return make_tunnel_scene({std::max(40.0, needed_m)}, rng);
    case SceneKind::kMotorway:
      return make_motorway_scene({std::max(40.0, needed_m)}, rng);
    case SceneKind::kInterior:
      // The way into three rooms and back is as long as about 16 m of corridor.
      return make_interior_scene({std::max(15.0, needed_m - 16)}, rng);
    case SceneKind::kPlaza:
      return make_plaza_scene({}, rng);
    case SceneKind::kBays: {
      BaysOptions bays = options.bays;
      bays.path_length_m = std::max(8.0, needed_m);
      return make_bays_scene(bays, rng);
    }
    case SceneKind::kStoreys: {
      StoreysOptions storeys;
      storeys.length_m = std::max(storeys.length_m, corridor_length_m(storeys.storeys, needed_m));
      return make_storeys_scene(storeys, rng);
    }
    case SceneKind::kTownGrid:
      return make_town_grid_scene({std::max(400.0, needed_m)}, rng);
  }
  throw InvalidOptions("simulate: unknown scene");
}

/// The options with the spacing that gives the overlap asked for, found on the scene as it would be without.
SceneSetOptions with_spacing(const SceneSetOptions& options, const RunContext& context) {
  SceneSetOptions out = options;
  if (!options.overlap) return out;
  const Scene scene = make_scene(options, context.seed);
  out.station_spacing_m = std::min(100.0, spacing_for_overlap(scene, options, context.seed, context.num_threads));
  return out;
}

/// A path that is made to measure may be a little shorter, where corners are cut.
void require_room(const SceneSetOptions& options, const Scene& scene) {
  constexpr double kCut = 0.9;
  const double needed_m = options.num_scans * options.station_spacing_m, length_m = path_length_m(scene.path);
  if (!options.overlap || length_m >= kCut * needed_m) return;
  throw InvalidOptions("simulate: overlap = " + std::to_string(*options.overlap) + " needs stations " +
                       std::to_string(options.station_spacing_m) + " m apart, and the path of " +
                       scene_name(options.scene) + " is only " + std::to_string(length_m) +
                       " m long; ask for fewer scans or more overlap");
}

/// How far errors add up: along a path, but across a town whose streets meet everywhere.
double drifting_way_m(SceneKind scene, const Points& path) {
  if (scene != SceneKind::kTownGrid) return path_length_m(path);
  Eigen::AlignedBox3d town;
  for (const auto& p : path) town.extend(p);
  return town.diagonal().norm();
}

/// Scan `index` and its truth. Each scan draws from its own stream: the others do not depend on it.
void add_scan(SceneSet& set, const RayCaster& caster, int index, int num_threads) {
  const std::string file = file_name(index);
  Rng rng = make_stream(set.seed, "scan", file);
  const Isometry3d T_world_scanner = make_station(set.scene, set.options, index, rng);
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

void SceneSetOptions::validate() const {
  town.validate();
  bays.validate();
  scanner.validate();
  if (initial_guess) initial_guess->validate();
  require(num_scans >= 1 && num_scans <= 1000, "num_scans", num_scans, "1..1000");
  require(station_spacing_m >= 1 && station_spacing_m <= 100, "station_spacing_m", station_spacing_m, "1..100");
  require(!overlap || (*overlap >= 0.05 && *overlap <= 0.95), "overlap", overlap.value_or(0), "0.05..0.95");
  require(scanner_height_m > 0 && std::isfinite(scanner_height_m), "scanner_height_m", scanner_height_m, "> 0");
  require(drift_share >= 0 && drift_share <= 0.01, "drift_share", drift_share, "0..0.01");
  require(max_tilt_deg >= 0 && max_tilt_deg <= 90, "max_tilt_deg", max_tilt_deg, "0..90");
  require(max_shift_m >= 0 && std::isfinite(max_shift_m), "max_shift_m", max_shift_m, ">= 0");
  const bool has_roof = scene == SceneKind::kInterior || scene == SceneKind::kBays || scene == SceneKind::kStoreys ||
                        scene == SceneKind::kTunnel;
  if (has_roof && scanner.sensor == SensorKind::kAerial)
    throw InvalidOptions("simulate: an aerial sensor sees nothing of " + scene_name(scene) +
                         " but its roof; choose another");
}

SceneSet simulate_scene_set(const SceneSetOptions& options, const RunContext& context) {
  options.validate();
  SceneSet set;
  set.options = with_spacing(options, context);
  set.seed = context.seed;
  set.scene = make_scene(set.options, context.seed);
  require_room(set.options, set.scene);
  set.truth.tolerance = options.tolerance;
  set.truth.tolerance.rmse_m += options.drift_share * drifting_way_m(options.scene, set.scene.path);
  // A scan bent by motion has no one pose: its ends lie half the way of a turn from where its middle says.
  if (options.scanner.sensor != SensorKind::kAerial)
    set.truth.tolerance.rmse_m += std::abs(options.scanner.speed_m_s) / options.scanner.turns_per_s / 2;
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
