#pragma once
// S of the paper: the cloud of all scans merged so far, in the reference scan's local frame.

#include <Eigen/Geometry>

#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

class MergedCloud {
 public:
  explicit MergedCloud(double voxel_size_m) : voxel_size_m_(voxel_size_m) {}

  /// Adds a scan's cloud under its pose.
  void add(const Cloud& cloud, const Eigen::Isometry3d& T_reference_scan);

  /// Where several scans have points a voxel keeps one mean point, so S grows with the area covered and not with the
  /// number of scans. Built anew after each change: O(N log N).
  ScanPyramid pyramid();

  /// The finest level of that pyramid alone.
  PyramidLevel level();

 private:
  double voxel_size_m_;
  Cloud cloud_;
};

}  // namespace tcm_icp
