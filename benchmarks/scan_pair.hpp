#pragma once
// Two scans with known poses, and starts a known way off the truth.

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// What every method is given: points sampled on one voxel grid, without normals.
struct ScanPair {
  std::string name;
  Points target, source;              ///< [m] each in its own frame
  Eigen::Isometry3d T_target_source;  ///< truth
  double voxel_size_m = 0;            ///< [m] edge of the grid: about 20,000 points of the denser scan
};

/// Two scans of the made-up street, 8 m and 20 degrees apart, 150,000 points each before sampling.
ScanPair street_pair();

/// Two files of a scene and its truth.json (or poses.json).
/// @throws InputError    where a file cannot be read
/// @throws InvalidInput  where the truth has no pose for one of them
ScanPair read_pair(const std::filesystem::path& target, const std::filesystem::path& source,
                   const std::filesystem::path& truth);

/// The truth turned by 5 degrees about the source's centroid and moved by 0.5 m, both in `count` seeded random
/// directions.
std::vector<Eigen::Isometry3d> starts_near_truth(const ScanPair& pair, std::size_t count);

}  // namespace tcm_icp
