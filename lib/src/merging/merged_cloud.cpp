#include "merging/merged_cloud.hpp"

#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {

void MergedCloud::add(const Cloud& cloud, const Eigen::Isometry3d& T_reference_scan) {
  const Cloud moved = transformed(cloud, T_reference_scan);
  cloud_.points.insert(cloud_.points.end(), moved.points.begin(), moved.points.end());
  cloud_.normals.insert(cloud_.normals.end(), moved.normals.begin(), moved.normals.end());
}

ScanPyramid MergedCloud::pyramid() {
  ScanPyramid pyramid(cloud_, voxel_size_m_, kNumPyramidLevels);
  cloud_ = pyramid.level(0).cloud;
  return pyramid;
}

PyramidLevel MergedCloud::level() {
  cloud_ = voxel_downsample(cloud_, voxel_size_m_);
  return {voxel_size_m_, cloud_};
}

}  // namespace tcm_icp
