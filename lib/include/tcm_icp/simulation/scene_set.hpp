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
  kBlock,  ///< around a block: the last scan overlaps the first
  kStreet  ///< along a street: far scans share nothing
};

/// "town", "block", "street"; @throws InvalidOptions  naming the scenes there are
SceneKind scene_kind_from_name(const std::string& name);
std::string scene_name(SceneKind kind);

struct SceneSetOptions {
  SceneKind scene = SceneKind::kTown;
  TownOptions town;
  double station_spacing_m = 14;  ///< [m] 1..100, of block and street, which are made as long as the scans need; not of
                                  ///< town, whose stations share out its street
  ScannerOptions scanner;
  int num_scans = 6;              ///< 1..1000, stations along the scene's path
  double scanner_height_m = 1.8;  ///< [m] > 0, above the ground
  double max_tilt_deg = 5;        ///< [deg] 0..90; each scan's frame is turned to any heading, tilted by up to this ...
  double max_shift_m = 40;        ///< [m] >= 0; ... and its origin lies up to this from the scanner
  Tolerance tolerance{0.5, 0.05};  ///< what truth.json asks of a pose, ...
  double drift_share = 0;  ///< 0..0.01; ... with this share of the path's length added to the distance: errors add up
  std::optional<PosePerturbation> initial_guess;  ///< poses to start from are made, too
  void validate() const;                          ///< throws InvalidOptions
};

/// Town: 6 scans. Block: 20, street: 60, both 14 m apart; their scanner reaches 40 m, their scans are thinned to 0.2 m,
/// and their tolerances grow with the path's length.
SceneSetOptions default_scene_set(SceneKind kind);

struct SceneSet {
  SceneSetOptions options;
  std::uint64_t seed = 0;
  Scene scene;                                   ///< in the world frame
  std::vector<LidarScan> scans;                  ///< each in its own frame
  std::vector<Eigen::Vector3d> scanner_in_scan;  ///< [m] where each scanner stood, in the scan's own frame
  Truth truth;                                   ///< files 000.ply, 001.ply, ...
  std::vector<Eigen::Isometry3d> initial_guess;  ///< T_world_scan, the first exact; empty unless asked for
};

/// @throws InvalidOptions, Cancelled
SceneSet simulate_scene_set(const SceneSetOptions& options, const RunContext& context);

/// Writes 000.ply ... (binary little endian, float x y z intensity), truth.json and, where there are initial guesses,
/// initial_poses.json into an existing folder.
/// @throws OutputError
void write_scene_set(const SceneSet& set, const std::filesystem::path& folder);

}  // namespace tcm_icp
