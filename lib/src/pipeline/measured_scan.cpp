#include "pipeline/measured_scan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "links/verification_at.hpp"
#include "merging/merged_cloud.hpp"
#include "tcm_icp/core/even_sample.hpp"

namespace tcm_icp {
namespace {

// Of a scan: those it overlaps most with say what there is to say, and each costs time.
constexpr std::size_t kMaxNeighbors = 6;
constexpr std::size_t kUnionPoints = 1000;

}  // namespace

ScanMeasurements measure_scan(const std::vector<PreparedScan>& scans, std::size_t scan,
                              const std::vector<LinkOfScan>& links, const std::vector<Eigen::Isometry3d>& T) {
  ScanMeasurements out;
  std::vector<std::pair<double, std::size_t>> neighbors;
  for (const LinkOfScan& link : links) {
    neighbors.emplace_back(-link.measurements->evidence.overlap, link.other);
    out.free_space += link.measurements->free_space;
  }
  if (neighbors.empty()) return out;
  std::sort(neighbors.begin(), neighbors.end());
  const double voxel_m = scans[scan].pyramid.level(0).voxel_size_m;
  MergedCloud cloud(voxel_m);
  for (std::size_t k = 0; k < std::min(kMaxNeighbors, neighbors.size()); ++k) {
    const std::size_t other = neighbors[k].second;
    cloud.add(scans[other].pyramid.level(0).cloud, T[other]);
  }
  out.evidence = verify_alignment(even_sample(scans[scan].verification_sample, kUnionPoints), cloud.level(), T[scan],
                                  verification_at(voxel_m));
  return out;
}

std::optional<double> sigma_in_voxels(const PoseUncertainty& uncertainty, const PointMoments& points,
                                      const Eigen::Isometry3d& T, double coarse_m) {
  if (!uncertainty.determined) return std::nullopt;
  const Eigen::Vector3d from_centre = T * points.mean - uncertainty.centre;
  const Eigen::Matrix3d spread =
      T.linear() * points.covariance * T.linear().transpose() + from_centre * from_centre.transpose();
  const Eigen::Matrix3d rotation = uncertainty.covariance.topLeftCorner<3, 3>();
  const double variance_m2 = (rotation * (spread.trace() * Eigen::Matrix3d::Identity() - spread)).trace() +
                             uncertainty.covariance.bottomRightCorner<3, 3>().trace();
  return std::sqrt(std::max(0.0, variance_m2)) / coarse_m;
}

}  // namespace tcm_icp
