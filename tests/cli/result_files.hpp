#pragma once
// What a registration wrote, read back.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/temp_files.hpp"
#include "run_program.hpp"
#include "tcm_icp/evaluation/metrics.hpp"
#include "tcm_icp/io/pose_io.hpp"

namespace tcm_icp::test {

inline nlohmann::json read_json(const std::filesystem::path& path) { return nlohmann::json::parse(read_text(path)); }

/// Scores poses of the town, in the order of its truth, against that truth.
inline SceneScore score_town(const std::vector<std::optional<Eigen::Isometry3d>>& poses, std::size_t reference) {
  const Truth truth = read_truth(town_file("truth.json"));
  std::vector<Points> points;
  for (const auto& scan : truth.scans) {
    points.push_back(read_whole(town_file(scan.file), ReadAttributes::kNo).block.points);
  }
  return score_poses(truth, poses, reference, points, {});
}

/// The same of a poses.json that has all scans of the town, in any order.
inline SceneScore score_town(const PoseFile& file) {
  const Truth truth = read_truth(town_file("truth.json"));
  std::vector<std::optional<Eigen::Isometry3d>> poses(truth.scans.size());
  std::size_t reference = 0;
  for (std::size_t i = 0; i < truth.scans.size(); ++i) {
    for (const auto& scan : file.scans) {
      if (scan.file != truth.scans[i].file || scan.status == ScanStatus::kUnregistered) continue;
      poses[i] = scan.T_reference_scan;
      if (scan.status == ScanStatus::kReference) reference = i;
    }
  }
  return score_town(poses, reference);
}

/// Largest distance [m] between where two poses put a point up to `radius_m` from the scan's origin.
inline double difference_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double radius_m) {
  return (a.translation() - b.translation()).norm() + radius_m * (a.linear() - b.linear()).norm();
}

}  // namespace tcm_icp::test
