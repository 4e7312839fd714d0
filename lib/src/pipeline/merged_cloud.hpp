#pragma once
// S of the paper: the cloud of all scans merged so far, in the reference scan's local frame.

#include <Eigen/Geometry>
#include <optional>

#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

class MergedCloud {
 public:
  explicit MergedCloud(double voxel_size_m) : voxel_size_m_(voxel_size_m) {}

  /// Adds a scan's cloud under its pose. Where S has points already the voxel keeps one mean point, so S grows with the area
  /// covered and not with the number of scans.
  void merge(const Cloud& cloud, const Eigen::Isometry3d& T_reference_scan);

  const ScanPyramid& pyramid() const { return *pyramid_; }

 private:
  double voxel_size_m_;
  Cloud cloud_;
  std::optional<ScanPyramid> pyramid_;
};

}  // namespace tcm_icp
