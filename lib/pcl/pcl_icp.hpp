#pragma once
// PCL's point-to-point ICP, in units of a voxel: its points are floats, and its thresholds have no unit of their own.

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <memory>

#include "tcm_icp/baselines/pair_fit.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

PclCloud::Ptr to_pcl(const Points& points, double unit_m);

/// A pose from PCL's 4 x 4 floats in units of `unit_m`.
Eigen::Isometry3d from_pcl(const Eigen::Matrix4f& T, double unit_m);
Eigen::Matrix4f to_pcl(const Eigen::Isometry3d& T, double unit_m);

/// In one unit.
struct PclTarget {
  PclCloud::Ptr cloud;
  std::shared_ptr<const NeighborIndex> index;
};

struct IcpStage {
  double reach_units = 0;  ///< correspondences farther apart are left out; 0: none is
  int max_iterations = 0;
};

/// ICP from the fit's pose; iterations are added, `converged` is that of this stage. Where PCL gives up (too few
/// correspondences), the pose stays.
void icp_stage(const PclCloud::Ptr& source, const PclTarget& target, double unit_m, const IcpStage& stage,
               PairFit& fit);

}  // namespace tcm_icp
