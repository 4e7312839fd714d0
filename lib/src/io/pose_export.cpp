#include "tcm_icp/io/pose_export.hpp"

#include "core/unit_quaternion.hpp"
#include "number_text.hpp"
#include "scan_status.hpp"
#include "tcm_icp/core/error.hpp"
#include "text_file.hpp"

namespace tcm_icp {
namespace {

bool is_registered(const ScanPose& pose) { return pose.status != ScanStatus::kUnregistered; }

/// Position, then quaternion x y z w with w >= 0.
std::string position_and_turn(const Eigen::Isometry3d& T, char separator) {
  const Eigen::Quaterniond q = unit_quaternion(T);
  std::string text;
  for (int axis = 0; axis < 3; ++axis) text += digits17(T.translation()[axis]) + separator;
  return text + digits17(q.x()) + separator + digits17(q.y()) + separator + digits17(q.z()) + separator +
         digits17(q.w());
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string poses_as_csv(const std::vector<ScanPose>& poses) {
  std::string text = "scan,file,status,component,x,y,z,qx,qy,qz,qw\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const ScanPose& pose = poses[i];
    text += std::to_string(i) + ',' + csv_field(pose.file) + ',';
    text += std::string(to_string(pose.status)) + ',' + std::to_string(pose.component) + ',';
    text += (is_registered(pose) ? position_and_turn(pose.T_reference_scan, ',') : std::string(6, ',')) + '\n';
  }
  return text;
}

std::string poses_as_tum(const std::vector<ScanPose>& poses) {
  std::string text;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!is_registered(poses[i])) continue;
    text += std::to_string(i) + ' ' + position_and_turn(poses[i].T_reference_scan, ' ') + '\n';
  }
  return text;
}

std::string poses_as_kitti(const std::vector<ScanPose>& poses) {
  std::string text;
  for (const ScanPose& pose : poses) {
    if (!is_registered(pose)) continue;
    for (int i = 0; i < 12; ++i) {
      text += digits17(pose.T_reference_scan.matrix()(i / 4, i % 4)) + (i < 11 ? ' ' : '\n');
    }
  }
  return text;
}

std::string poses_as_g2o(const std::vector<ScanPose>& poses, const std::vector<PoseGraphEdge>& edges) {
  std::string text;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!is_registered(poses[i])) continue;
    text += "VERTEX_SE3:QUAT " + std::to_string(i) + ' ' + position_and_turn(poses[i].T_reference_scan, ' ') + '\n';
  }
  for (const PoseGraphEdge& edge : edges) {
    if (!is_registered(poses.at(edge.from)) || !is_registered(poses.at(edge.to))) {
      throw InvalidInput("an edge of the pose graph names a scan that is not registered");
    }
    const Eigen::Isometry3d T = poses[edge.from].T_reference_scan.inverse() * poses[edge.to].T_reference_scan;
    text +=
        "EDGE_SE3:QUAT " + std::to_string(edge.from) + ' ' + std::to_string(edge.to) + ' ' + position_and_turn(T, ' ');
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) text += ' ' + digits17(edge.information(row, column));
    }
    text += '\n';
  }
  return text;
}

void write_pose_exports(const std::filesystem::path& folder, const std::vector<ScanPose>& poses,
                        const std::vector<PoseGraphEdge>& edges) {
  write_text_file(folder / "poses.csv", poses_as_csv(poses));
  write_text_file(folder / "tum.txt", poses_as_tum(poses));
  write_text_file(folder / "kitti.txt", poses_as_kitti(poses));
  write_text_file(folder / "graph.g2o", poses_as_g2o(poses, edges));
}

}  // namespace tcm_icp
