#pragma once
// What the 3D view and the pictures of a report show: points of the registered scans, how far they are from the other
// scans, and groups of scans that hold together in frames of their own.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "report/scene_sample.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

struct SceneScan {
  std::size_t group = 0;                ///< position in Scene::groups, whose view frame is meant below
  std::vector<Eigen::Vector3f> points;  ///< [m] local frame
  /// Of each point the distance to another scan's surface: 254 sqrt(d / most_m); kNoSurface where none is near.
  std::vector<std::uint8_t> distances;
  Eigen::Isometry3d T_view_scan = Eigen::Isometry3d::Identity();   ///< in its group: view frame <- local frame
  Eigen::Isometry3d T_input_scan = Eigen::Isometry3d::Identity();  ///< as the files have it
  std::optional<Eigen::Vector3d> setup;                            ///< [m] where it was taken from, view frame
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();                ///< [m] median point, view frame
};

/// Scans in one frame. Those of different groups have nothing to do with each other.
struct SceneGroup {
  int component = 0;                                 ///< 0: the common frame
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m] view frame = frame of the group minus this
  Eigen::AlignedBox3d box;                           ///< [m] about all but stray points, view frame
};

struct Scene {
  static constexpr std::uint8_t kNoSurface = 255;

  std::vector<SceneScan> scans;       ///< all of the run; those without a pose in any group have no points
  double most_m = 0;                  ///< [m] distance that is 254; 0: distances are not known
  std::vector<SceneGroup> groups{1};  ///< first the registered scans, then groups that are not registered with them

  const SceneGroup& registered() const { return groups.front(); }
  std::size_t num_points() const;
};

/// About the points of a group's scans in its view frame, without the outermost half percent on either side of each
/// axis.
Eigen::AlignedBox3d box_without_stray_points(const Scene& scene, std::size_t group = 0);

/// @param points  of each scan, local frame
/// Cost: O(points + matches of links).
Scene make_scene(const PipelineResult& result, ScenePoints points, int num_threads);

}  // namespace tcm_icp
