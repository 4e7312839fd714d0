#include "pcl_registration.hpp"

#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

constexpr int kMaxIterations = 100;

pcl::PointCloud<pcl::PointXYZ>::Ptr to_pcl(const Points& points) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const auto& p : points) {
    const Eigen::Vector3f f = p.cast<float>();
    cloud->push_back({f.x(), f.y(), f.z()});
  }
  return cloud;
}

pcl::PointCloud<pcl::PointNormal>::Ptr to_pcl(const Cloud& cloud) {
  const auto out = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  out->reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.normals[i].isZero()) continue;
    const Eigen::Vector3f p = cloud.points[i].cast<float>(), n = cloud.normals[i].cast<float>();
    out->push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z()});
  }
  return out;
}

template <typename Icp>
void set_convergence(Icp& icp) {
  icp.setMaximumIterations(kMaxIterations);
  icp.setTransformationEpsilon(1e-8);    // [m^2] of the translation, and 1 - cos of the rotation
  icp.setEuclideanFitnessEpsilon(1e-6);  // share of the mean squared error
}

template <typename Icp>
Eigen::Isometry3d align(Icp& icp, const Eigen::Isometry3d& T_init, const std::vector<double>& gates_m) {
  Eigen::Isometry3d T = T_init;
  typename Icp::PointCloudSource moved;
  for (const double gate_m : gates_m) {
    icp.setMaxCorrespondenceDistance(gate_m);
    icp.align(moved, T.matrix().template cast<float>());
    T.matrix() = icp.getFinalTransformation().template cast<double>();
    T.linear() = project_onto_so3(T.linear());
  }
  return T;
}

}  // namespace

Eigen::Isometry3d pcl_icp(const Points& source, const Points& target, const Eigen::Isometry3d& T_init,
                          const std::vector<double>& gates_m) {
  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  set_convergence(icp);
  icp.setInputSource(to_pcl(source));
  icp.setInputTarget(to_pcl(target));
  return align(icp, T_init, gates_m);
}

Eigen::Isometry3d pcl_point_to_plane(const Cloud& source, const Cloud& target, const Eigen::Isometry3d& T_init,
                                     const std::vector<double>& gates_m) {
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  set_convergence(icp);
  icp.setInputSource(to_pcl(source));
  icp.setInputTarget(to_pcl(target));
  return align(icp, T_init, gates_m);
}

Eigen::Isometry3d pcl_gicp(const Points& source, const Points& target, const Eigen::Isometry3d& T_init,
                           const std::vector<double>& gates_m, double smallest_step) {
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  icp.setMaximumIterations(kMaxIterations);
  if (smallest_step > 0) {
    icp.setTransformationEpsilon(smallest_step);
    icp.setRotationEpsilon(smallest_step);
  }
  icp.setInputSource(to_pcl(source));
  icp.setInputTarget(to_pcl(target));
  return align(icp, T_init, gates_m);
}

}  // namespace tcm_icp
