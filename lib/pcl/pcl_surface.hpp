#pragma once
// Points with normals as PCL's features and point-to-plane ICP need them.

#include <pcl/common/centroid.h>
#include <pcl/common/io.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/filter.h>
#include <pcl/point_types.h>

#include <memory>

#include "pcl_search.hpp"

namespace tcm_icp {

struct PclSurface {
  pcl::PointCloud<pcl::PointNormal>::Ptr points;
  std::shared_ptr<const NeighborIndex> index;  ///< of them
};

/// With normals of the neighbours within `radius` [unit of the cloud], towards the centroid; points without are left
/// out.
inline PclSurface pcl_surface_of(const pcl::PointCloud<pcl::PointXYZ>& cloud, double radius) {
  PclSurface out{pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>(), nullptr};
  pcl::copyPointCloud(cloud, *out.points);
  out.index = index_of(*out.points);
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
  Eigen::Vector4f middle;
  pcl::compute3DCentroid(*out.points, middle);
  normals.setViewPoint(middle.x(), middle.y(), middle.z());
  normals.setInputCloud(out.points);
  normals.setSearchMethod(pcl::make_shared<PclSearch<pcl::PointNormal>>(out.index));
  normals.setRadiusSearch(radius);
  normals.compute(*out.points);
  pcl::Indices kept;
  pcl::removeNaNNormalsFromPointCloud(*out.points, *out.points, kept);
  if (kept.size() < out.index->size()) out.index = index_of(*out.points);
  return out;
}

}  // namespace tcm_icp
