#pragma once
// The points of a scan that say where they are: keypoints with their descriptors, at one resolution.

#include <cstddef>

#include "tcm_icp/coarse/fpfh.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

struct FeatureOptions {
  double radius_voxels = 5;              ///< > 1; neighbourhood of a descriptor, in voxels of its level
  double normal_radius_voxels = 3;       ///< > 1, at most radius_voxels; neighbourhood of a normal
  double keypoint_spacing_voxels = 1.2;  ///< >= 0, at most radius_voxels; keypoints keep this distance
  int max_keypoints = 1000;              ///< >= 1; of a level
  void validate() const;                 ///< throws InvalidOptions
};

/// Keypoints of one level, in the order of the level's points.
struct ScanFeatures {
  double voxel_size_m = 0;
  Cloud keypoints;
  Descriptors descriptors;  ///< one column a keypoint
};

/// Describes all points of the level and keeps those whose descriptors are least like the scan's mean one: the middles
/// of planes look alike wherever they are. Keypoints carry the normals their descriptors were made with. Cost O(N k), k
/// points in the neighbourhood.
ScanFeatures find_features(const PyramidLevel& level, const FeatureOptions& options);

}  // namespace tcm_icp
