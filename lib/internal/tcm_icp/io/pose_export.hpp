#pragma once
// Poses in the formats other programs read (docs/formats.md). Unregistered scans have no pose in any of them.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tcm_icp/io/pose_io.hpp"

namespace tcm_icp {

/// A link between two registered scans, by their places in the list.
struct PoseGraphEdge {
  std::size_t from = 0, to = 0;
  /// As g2o has it: of T_from_to's error (translation [m], vector part of the unit quaternion), in the frame of `to`.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity();
};

/// A line of column names, then every scan: number on the command line from 0, file, status, component, position,
/// quaternion x y z w. What an unregistered scan does not have is empty. Quoted as RFC 4180 asks for.
std::string poses_as_csv(const std::vector<ScanPose>& poses);

/// A registered scan a line: number, position, quaternion x y z w. The number stands where TUM has the time.
std::string poses_as_tum(const std::vector<ScanPose>& poses);

/// A registered scan a line: the upper three rows of its matrix, rows first.
std::string poses_as_kitti(const std::vector<ScanPose>& poses);

/// VERTEX_SE3:QUAT of each registered scan, its number as id; EDGE_SE3:QUAT with the relative pose of these. Nothing
/// else: many readers stop at a comment.
/// @throws InvalidInput  if an edge names a scan that is not registered
std::string poses_as_g2o(const std::vector<ScanPose>& poses, const std::vector<PoseGraphEdge>& edges);

/// Writes poses.csv, tum.txt, kitti.txt and graph.g2o into `folder`, which must be there.
/// @throws OutputError  if a file cannot be written
void write_pose_exports(const std::filesystem::path& folder, const std::vector<ScanPose>& poses,
                        const std::vector<PoseGraphEdge>& edges);

}  // namespace tcm_icp
