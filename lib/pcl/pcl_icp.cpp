#include "pcl_icp.hpp"

#include <pcl/registration/icp.h>

#include "pcl_search.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

// Done when an iteration changes the mean squared distance by less than this share.
constexpr double kRelativeChange = 1e-5;

class Icp : public pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> {
 public:
  int iterations() const { return nr_iterations_; }
  bool ran_out() {
    using Criteria = pcl::registration::DefaultConvergenceCriteria<float>;
    return getConvergeCriteria()->getConvergenceState() == Criteria::CONVERGENCE_CRITERIA_ITERATIONS;
  }
};

}  // namespace

PclCloud::Ptr to_pcl(const Points& points, double unit_m) {
  auto cloud = pcl::make_shared<PclCloud>();
  cloud->reserve(points.size());
  for (const auto& p : points) {
    const Eigen::Vector3f q = (p / unit_m).cast<float>();
    cloud->emplace_back(q.x(), q.y(), q.z());
  }
  return cloud;
}

Eigen::Isometry3d from_pcl(const Eigen::Matrix4f& T, double unit_m) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = project_onto_so3(T.topLeftCorner<3, 3>().cast<double>());
  out.translation() = unit_m * T.topRightCorner<3, 1>().cast<double>();
  return out;
}

Eigen::Matrix4f to_pcl(const Eigen::Isometry3d& T, double unit_m) {
  Eigen::Isometry3d scaled = T;
  scaled.translation() /= unit_m;
  return scaled.matrix().cast<float>();
}

void icp_stage(const PclCloud::Ptr& source, const PclTarget& target, double unit_m, const IcpStage& stage,
               PairFit& fit) {
  Icp icp;
  icp.setInputSource(source);
  icp.setInputTarget(target.cloud);
  const double reach = stage.reach_units > 0 ? stage.reach_units : std::numeric_limits<double>::infinity();
  icp.setSearchMethodTarget(pcl::make_shared<PclSearch<pcl::PointXYZ>>(target.index, reach), true);
  icp.setMaximumIterations(stage.max_iterations);
  icp.setEuclideanFitnessEpsilon(kRelativeChange);
  if (stage.reach_units > 0) icp.setMaxCorrespondenceDistance(stage.reach_units);
  PclCloud moved;
  icp.align(moved, to_pcl(fit.T_target_source, unit_m));
  fit.icp_iterations += icp.iterations();
  fit.converged = icp.hasConverged() && !icp.ran_out();
  if (icp.hasConverged()) fit.T_target_source = from_pcl(icp.getFinalTransformation(), unit_m);
}

}  // namespace tcm_icp
