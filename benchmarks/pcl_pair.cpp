#include "pcl_pair.hpp"

#include <pcl/features/fpfh.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/sample_consensus_prerejective.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

using Search = PclSearch<pcl::PointNormal>;

constexpr int kCandidates = 5;  // of each feature

/// How many points of `source`, moved by T, have a neighbour within `reach_m` in the target.
std::size_t count_near(const PclSurface& source, const PclSurface& target, const Eigen::Isometry3d& T, double reach_m) {
  const auto& points = *source.points;
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const pcl::PointNormal& p) {
    return target.index->any_within(T * p.getVector3fMap().cast<double>(), reach_m);
  }));
}

}  // namespace

PclScan pcl_read(const std::string& file) {
  ScanReader reader(file, ReadAttributes::kNo);
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  PclScan out{cloud, Eigen::Vector3d::Zero()};
  for (PointBlock block; reader.read(block);) {
    if (cloud->empty()) out.origin = block.points.front();
    for (const Eigen::Vector3d& p : block.points) {
      const Eigen::Vector3f q = (p - out.origin).cast<float>();
      cloud->emplace_back(q.x(), q.y(), q.z());
    }
  }
  return out;
}

double pcl_spacing(const PclCloud& scan) {
  const auto index = index_of(*scan);
  std::vector<Neighbor> two;
  std::vector<double> distances;
  for (const auto& p : *scan) {
    index->nearest_k({p.x, p.y, p.z}, 2, two);
    if (two.size() == 2) distances.push_back(std::sqrt(two[1].squared_distance_m2));
  }
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
  return pcl_surface_of(*pcl_voxel_sample(scan, voxel_m), 2 * voxel_m);
}

PclPrepared pcl_prepare(const PclCloud& scan, double voxel_m) {
  PclPrepared out{pcl_surface(scan, voxel_m), pcl::make_shared<pcl::PointCloud<pcl::FPFHSignature33>>()};
  pcl::FPFHEstimation<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> features;
  features.setInputCloud(out.surface.points);
  features.setInputNormals(out.surface.points);
  features.setSearchMethod(pcl::make_shared<Search>(out.surface.index));
  features.setRadiusSearch(5 * voxel_m);
  features.compute(*out.features);
  return out;
}

Eigen::Isometry3d pcl_refine(const PclSurface& source, const PclSurface& target, const Eigen::Isometry3d& T_init,
                             double reach_m) {
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setInputSource(source.points);
  icp.setInputTarget(target.points);
  icp.setSearchMethodTarget(pcl::make_shared<Search>(target.index, reach_m), true);
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
  // PCL reads past the end of clouds with fewer points than a feature's candidates.
  if (std::min(source.features->size(), target.features->size()) < std::size_t{kCandidates}) return link;
  const double reach_m = 2.5 * voxel_m;
  pcl::PointCloud<pcl::PointNormal> moved;
  pcl::SampleConsensusPrerejective<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> coarse;
  coarse.setInputSource(source.surface.points);
  coarse.setSourceFeatures(source.features);
  coarse.setInputTarget(target.surface.points);
  coarse.setSearchMethodTarget(pcl::make_shared<Search>(target.surface.index, reach_m), true);
  coarse.setTargetFeatures(target.features);
  coarse.setMaximumIterations(50000);
  coarse.setNumberOfSamples(3);
  coarse.setCorrespondenceRandomness(kCandidates);
  coarse.setSimilarityThreshold(0.9F);
  coarse.setMaxCorrespondenceDistance(reach_m);
  coarse.setInlierFraction(0.1F);  // the tutorial's 0.25 is for an object that is wholly in the scene
  coarse.align(moved);
  if (!coarse.hasConverged()) return link;

  Eigen::Isometry3d T_coarse;
  T_coarse.matrix() = coarse.getFinalTransformation().cast<double>();
  T_coarse.linear() = project_onto_so3(T_coarse.linear());
  link.T_target_source = pcl_refine(source.surface, target.surface, T_coarse, 1.5 * voxel_m);

  const std::size_t near = count_near(source.surface, target.surface, link.T_target_source, 1.5 * voxel_m);
  const std::size_t smaller = std::min(source.surface.points->size(), target.surface.points->size());
  link.share = static_cast<double>(near) / static_cast<double>(smaller);
  return link;
}

}  // namespace tcm_icp
