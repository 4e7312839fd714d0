#pragma once
// A synthetic scene as files with rough initial poses, run through the pipeline and measured against the truth.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "io/temp_files.hpp"
#include "support/ply_file.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"

namespace tcm_icp::testing {

struct SceneFiles {
  SyntheticScene scene;
  std::vector<std::filesystem::path> paths;
  InitialPoses initial;  ///< scan to world, disturbed

  /// Puts another scan in place of scan i, as if it had been taken from where that one stands.
  void replace(std::size_t i, const Cloud& cloud) {
    scene.scans[i] = cloud;
    write_ply(paths[i], cloud.points);
  }
};

/// Scan i is `i`.ply in `folder`, in units of 1/`factor` of the scene's.
inline SceneFiles write_scene(const std::filesystem::path& folder, const SyntheticSceneOptions& options,
                              double angle_rad, double shift_m, std::uint64_t seed, double factor = 1) {
  Rng rng = make_stream(seed, "scene files");
  SceneFiles files{synthetic_scene(options, rng), {}, {}};
  files.scene.spacing_m *= factor;
  for (std::size_t i = 0; i < files.scene.scans.size(); ++i) {
    Cloud& cloud = files.scene.scans[i];
    Eigen::Isometry3d& T = files.scene.T_world_scan[i];
    files.initial.emplace_back(scaled_pose(perturbed(T, cloud.points, angle_rad, shift_m, rng), factor));
    cloud = scaled_cloud(cloud, factor);
    T = scaled_pose(T, factor);
    files.paths.push_back(write_ply(folder / (std::to_string(i) + ".ply"), cloud.points));
  }
  return files;
}

/// Largest error [m] of a pose against the reference, over the scans that were registered.
inline double worst_error_m(const SceneFiles& files, const PipelineResult& result) {
  double worst = 0;
  for (std::size_t i = 0; i < files.scene.scans.size(); ++i) {
    if (result.poses[i].status == ScanStatus::kUnregistered) continue;
    worst = std::max(worst, pose_rmse_m(files.scene.T_target_source(result.reference, i),
                                        result.poses[i].T_reference_scan, files.scene.scans[i].points));
  }
  return worst;
}

/// The same of the initial poses.
inline double worst_initial_error_m(const SceneFiles& files, std::size_t reference) {
  double worst = 0;
  for (std::size_t i = 0; i < files.scene.scans.size(); ++i) {
    worst = std::max(worst,
                     pose_rmse_m(files.scene.T_target_source(reference, i),
                                 files.initial[reference]->inverse() * *files.initial[i], files.scene.scans[i].points));
  }
  return worst;
}

}  // namespace tcm_icp::testing
