#pragma once
// PCL's global registration of a pair, with our nearest neighbours (lib/pcl/pcl_search.hpp): with FLANN's it takes up
// to ten times as long, for the same answers.

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>
#include <string>

#include "pcl_surface.hpp"

namespace tcm_icp {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>::ConstPtr;

/// PCL's points are floats: they are relative to the first.
struct PclScan {
  PclCloud cloud;
  Eigen::Vector3d origin;  ///< the first point, in the scan's frame
};

/// What register reads, by the same reader.
/// @throws InputError  where the file cannot be read
PclScan pcl_read(const std::string& file);

/// Median distance to the nearest neighbour.
double pcl_spacing(const PclCloud& scan);

PclCloud pcl_voxel_sample(const PclCloud& scan, double voxel_m);

/// Sampled to voxels, with normals within 2 of them; points without neighbours are left out.
PclSurface pcl_surface(const PclCloud& scan, double voxel_m);

struct PclPrepared {
  PclSurface surface;
  pcl::PointCloud<pcl::FPFHSignature33>::Ptr features;
};

/// With features within 5 voxels.
PclPrepared pcl_prepare(const PclCloud& scan, double voxel_m);

struct PclLink {
  std::size_t source = 0, target = 0;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  double share = 0;  ///< of the smaller cloud's size that has a partner within 1.5 voxels; 0 where nothing was found
};
PclLink pcl_align_pair(const PclPrepared& source, const PclPrepared& target, double voxel_m);

/// Point-to-plane ICP from T_init with correspondences up to `reach_m`; T_init itself where it does not converge.
Eigen::Isometry3d pcl_refine(const PclSurface& source, const PclSurface& target, const Eigen::Isometry3d& T_init,
                             double reach_m);

}  // namespace tcm_icp
