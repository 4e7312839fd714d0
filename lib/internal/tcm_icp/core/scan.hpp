#pragma once
// One acquisition: its name, and the bounded working cloud that stands for it.

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

struct Scan {
  std::string file;                                  ///< name of the scan, as poses.json has it
  std::string unit = "m";                            ///< of the coordinates in its file; all lengths here are metres
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m] subtracted from raw coordinates on reading
  Cloud cloud;                                       ///< working cloud, local frame (raw minus origin)
  double voxel_size_m = 0;                           ///< [m] voxel edge of the working cloud
  double spacing_m = 0;                              ///< [m] median nearest-neighbour distance of the working cloud
  double noise_m = 0;                                ///< [m] median deviation from the local plane
  double coverage_m = 0;                             ///< [m] voxel edge from which on its points cover surfaces
  double extent_m = 0;                               ///< [m] 90th percentile of the distance from the median point
  std::uint64_t num_raw_points = 0;                  ///< finite points of the file
  std::uint64_t num_dropped_points = 0;              ///< NaN or infinite points of the file
};

/// What random numbers of a scan are drawn by: the number of its points, which neither a name nor a frame nor a unit
/// changes. Two scans may have one key: each draws from its own points.
inline std::string stream_key(const Scan& scan) { return std::to_string(scan.num_raw_points); }

}  // namespace tcm_icp
