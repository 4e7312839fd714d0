#pragma once
// The town as other programs would export it: other units, other frames, other names for nothing else.

#include <Eigen/Geometry>
#include <string>

#include "io/ply_text.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {

inline std::string town_name(std::size_t i) { return "00" + std::to_string(i) + ".ply"; }

/// Scan i of the town, its points moved by `A` (also by what is no rigid motion), as a PLY file of doubles.
inline void write_moved(const TempFolder& folder, std::size_t i, const Eigen::Affine3d& A) {
  const WholeScan scan = read_whole(town_file(town_name(i)), ReadAttributes::kNo);
  std::string content = ply_header("binary_little_endian", xyz_vertices(scan.block.size(), "double"));
  for (const auto& p : scan.block.points) {
    const Eigen::Vector3d q = A * p;
    for (int axis = 0; axis < 3; ++axis) content += bytes_of(q[axis]);
  }
  folder.write(town_name(i), content);
}

/// The poses of scans moved by `moves` (all of one scale), said for the town's own files.
inline PoseFile moved_back(PoseFile file, const std::vector<Eigen::Affine3d>& moves) {
  const auto number = [](const std::string& name) { return static_cast<std::size_t>(name[2] - '0'); };
  const Eigen::Affine3d& of_reference = moves[number(file.reference)];
  for (auto& scan : file.scans) {
    if (scan.status == ScanStatus::kUnregistered) continue;
    const Eigen::Affine3d T = of_reference.inverse() * scan.T_reference_scan * moves[number(scan.file)];
    scan.T_reference_scan.matrix() = T.matrix();
  }
  return file;
}

}  // namespace tcm_icp::test
