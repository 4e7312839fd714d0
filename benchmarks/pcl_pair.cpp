#include "pcl_pair.hpp"

#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/filter.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/ply_io.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/sample_consensus_prerejective.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <stdexcept>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

/// How many points of `points`, moved by T, have a neighbour within `reach_m` in the tree.
std::size_t count_near(const pcl::PointCloud<pcl::PointNormal>& points, const Eigen::Isometry3d& T,
                       const pcl::KdTreeFLANN<pcl::PointNormal>& tree, double reach_m) {
  const Eigen::Isometry3f moved = T.cast<float>();
  pcl::Indices index(1);
  std::vector<float> squared_distance(1);
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](pcl::PointNormal p) {
    p.getVector3fMap() = moved * p.getVector3fMap();
    return tree.nearestKSearch(p, 1, index, squared_distance) > 0 && squared_distance[0] <= reach_m * reach_m;
  }));
}

}  // namespace

PclCloud pcl_read(const std::string& file) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  if (pcl::io::loadPLYFile(file, *cloud) < 0) throw std::runtime_error(file + ": cannot be read");
  pcl::Indices kept;
  pcl::removeNaNFromPointCloud(*cloud, *cloud, kept);
  return cloud;
}

double pcl_spacing(const PclCloud& scan) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(scan);
  pcl::Indices indices(2);
  std::vector<float> squared(2), distances;
  for (const auto& p : *scan)
    if (tree.nearestKSearch(p, 2, indices, squared) == 2) distances.push_back(std::sqrt(squared[1]));
  if (distances.empty()) throw std::runtime_error("a scan has fewer than two points");
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

PclCloud pcl_voxel_sample(const PclCloud& scan, double voxel_m) {
  const auto out = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  const auto leaf = static_cast<float>(voxel_m);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setInputCloud(scan);
  grid.filter(*out);
  return out;
}

PclSurface pcl_surface(const PclCloud& scan, double voxel_m) {
  auto surface = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  pcl::copyPointCloud(*pcl_voxel_sample(scan, voxel_m), *surface);
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
  Eigen::Vector4f middle;
  pcl::compute3DCentroid(*surface, middle);
  normals.setViewPoint(middle.x(), middle.y(), middle.z());
  normals.setInputCloud(surface);
  normals.setRadiusSearch(2 * voxel_m);
  normals.compute(*surface);
  pcl::Indices kept;
  pcl::removeNaNNormalsFromPointCloud(*surface, *surface, kept);
  return surface;
}

PclPrepared pcl_prepare(const PclCloud& scan, double voxel_m) {
  PclPrepared out{pcl_surface(scan, voxel_m), pcl::make_shared<pcl::PointCloud<pcl::FPFHSignature33>>()};
  pcl::FPFHEstimation<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> features;
  features.setInputCloud(out.points);
  features.setInputNormals(out.points);
  features.setRadiusSearch(5 * voxel_m);
  features.compute(*out.features);
  return out;
}

Eigen::Isometry3d pcl_refine(const PclSurface& source, const PclSurface& target, const Eigen::Isometry3d& T_init,
                             double reach_m) {
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(reach_m);
  icp.setMaximumIterations(50);
  icp.setTransformationEpsilon(1e-8);
  pcl::PointCloud<pcl::PointNormal> moved;
  icp.align(moved, T_init.matrix().cast<float>());
  if (!icp.hasConverged()) return T_init;
  Eigen::Isometry3d T;
  T.matrix() = icp.getFinalTransformation().cast<double>();
  T.linear() = project_onto_so3(T.linear());
  return T;
}

PclLink pcl_align_pair(const PclPrepared& source, const PclPrepared& target, double voxel_m) {
  PclLink link;
  pcl::PointCloud<pcl::PointNormal> moved;
  pcl::SampleConsensusPrerejective<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> coarse;
  coarse.setInputSource(source.points);
  coarse.setSourceFeatures(source.features);
  coarse.setInputTarget(target.points);
  coarse.setTargetFeatures(target.features);
  coarse.setMaximumIterations(50000);
  coarse.setNumberOfSamples(3);
  coarse.setCorrespondenceRandomness(5);
  coarse.setSimilarityThreshold(0.9F);
  coarse.setMaxCorrespondenceDistance(2.5 * voxel_m);
  coarse.setInlierFraction(0.1F);  // the tutorial's 0.25 is for an object that is wholly in the scene
  coarse.align(moved);
  if (!coarse.hasConverged()) return link;

  Eigen::Isometry3d T_coarse;
  T_coarse.matrix() = coarse.getFinalTransformation().cast<double>();
  T_coarse.linear() = project_onto_so3(T_coarse.linear());
  link.T_target_source = pcl_refine(source.points, target.points, T_coarse, 1.5 * voxel_m);

  pcl::KdTreeFLANN<pcl::PointNormal> tree;
  tree.setInputCloud(target.points);
  const std::size_t near = count_near(*source.points, link.T_target_source, tree, 1.5 * voxel_m);
  link.share = static_cast<double>(near) / static_cast<double>(std::min(source.points->size(), target.points->size()));
  return link;
}

}  // namespace tcm_icp
