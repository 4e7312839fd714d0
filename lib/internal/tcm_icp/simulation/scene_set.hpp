#pragma once
// A set of overlapping scans of a made-up scene, each in a frame of its own, with exact truth.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/evaluation/truth.hpp"
#include "tcm_icp/simulation/lidar.hpp"
#include "tcm_icp/simulation/perturb_pose.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {

enum class SceneKind {
  kTown,
  kBlock,     ///< around a block: the last scan overlaps the first
  kStreet,    ///< mobile scans of a strip of road: far scans share nothing
  kUrban,     ///< buildings and trees around a corner, from a moving platform with a sensor of low accuracy
  kCanopy,    ///< a lake shore with many small things, under an open tree canopy
  kOrchard,   ///< trees in equal rows
  kTunnel,    ///< equal rings
  kMotorway,  ///< rails, a wall of equal panels
  kInterior,  ///< rooms and a corridor
  kPlaza,     ///< a square before a symmetric building
  kBays,      ///< a large building with columns: a place that repeats itself
  kStoreys,   ///< rooms on storeys that are alike, joined by stairs
  kTownGrid   ///< all streets of a town of several blocks: loops, and few neighbours for each scan
};

/// "town", "block", "street", "urban", "canopy", "orchard", "tunnel", "motorway", "interior", "plaza", "bays",
/// "storeys", "town-grid";
/// @throws InvalidOptions naming the scenes there are
SceneKind scene_kind_from_name(const std::string& name);
std::string scene_name(SceneKind kind);
std::vector<SceneKind> scene_kinds();

struct SceneSetOptions {
  SceneKind scene = SceneKind::kTown;
  TownOptions town;
  BaysOptions bays;               ///< but for the path's length, which is what the scans need
  double station_spacing_m = 14;  ///< [m] 1..100; all scenes but town and plaza, whose stations share out their path,
                                  ///< are made as long as the scans need
  std::optional<double> overlap;  ///< 0.05..0.95; the spacing is chosen so that neighbours share about this much
  ScannerOptions scanner;
  int num_scans = 6;              ///< 1..1000, stations along the scene's path
  double scanner_height_m = 1.8;  ///< [m] > 0, above the ground
  double max_tilt_deg = 5;        ///< [deg] 0..90; each scan's frame is turned to any heading, tilted by up to this ...
  double max_shift_m = 40;        ///< [m] >= 0; ... and its origin lies up to this from the scanner
  Tolerance tolerance{0.5, 0.05};  ///< what truth.json asks of a pose, with half the way of a turn where scans are bent
                                   ///< by motion, ...
  double drift_share = 0;  ///< 0..0.01; ... with this share of the path's length (of town-grid, the town's) added to
                           ///< the distance: errors add up
  std::optional<PosePerturbation> initial_guess;  ///< poses to start from are made, too
  void validate() const;                          ///< throws InvalidOptions
};

/// What suits a scene: its sensor, number of scans, spacing and tolerance. Tolerances of block and street grow with the
/// path's length, those of town-grid with the town's.
SceneSetOptions default_scene_set(SceneKind kind);

/// Another sensor in that scene, with its own defaults, height and tolerance. The scene's own sensor changes nothing.
void use_sensor(SceneSetOptions& options, SensorKind sensor);

struct SceneSet {
  SceneSetOptions options;
  std::uint64_t seed = 0;
  Scene scene;                                   ///< in the world frame
  std::vector<LidarScan> scans;                  ///< each in its own frame
  std::vector<Eigen::Vector3d> scanner_in_scan;  ///< [m] where each scanner stood, in the scan's own frame
  Truth truth;                                   ///< files 000.ply, 001.ply, ...
  std::vector<Eigen::Isometry3d> initial_guess;  ///< T_world_scan, the first exact; empty unless asked for
};

/// @throws InvalidOptions  also where a scan has no returns, or a path is too short for the overlap that is wanted
/// @throws Cancelled
/// Cost: that of the scans; `overlap` takes 28 more.
SceneSet simulate_scene_set(const SceneSetOptions& options, const RunContext& context);

/// Writes 000.ply ... (binary little endian, float x y z intensity), truth.json and, where there are initial guesses,
/// initial_poses.json into an existing folder.
/// @throws OutputError
void write_scene_set(const SceneSet& set, const std::filesystem::path& folder);

}  // namespace tcm_icp
