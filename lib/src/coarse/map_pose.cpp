#include "map_pose.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/decompositions.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMinCells = 30;
constexpr int kIterations = 5;

// Offset and slopes of the height differences over (x, y), by least squares with weights that make it an L1 fit.
// Levelling errs by a few degrees where the ground slopes, and less far from the middle than the maps are wide.
Eigen::Vector3d fit_plane(const Points& at, const std::vector<double>& difference_m, double scale_m) {
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  std::vector<double> copy = difference_m;
  plane[0] = median(copy);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    std::vector<double> residual(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      residual[i] = std::abs(difference_m[i] - plane.dot(Eigen::Vector3d(1, at[i].x() / scale_m, at[i].y() / scale_m)));
    }
    copy = residual;
    const double spread = median(copy);
    if (!(spread > 0)) break;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Eigen::Vector3d row(1, at[i].x() / scale_m, at[i].y() / scale_m);
      const double u = residual[i] / spread, weight = 1 / (1 + u * u);
      A += weight * row * row.transpose();
      b += weight * difference_m[i] * row;
    }
    // A few cells' worth of preference for no slope: a narrow strip does not show it across.
    A.diagonal().tail<2>().array() += 0.01 * static_cast<double>(at.size());
    plane = A.ldlt().solve(b);
  }
  return plane;
}

}  // namespace

Eigen::Isometry3d lift_pose(const HeightMap& target, const HeightMap& source, const MapCells& cells,
                            const MapPeak& pose) {
  const SharedCells shared = shared_cells(target, source, cells, pose);
  Eigen::Isometry3d T_map_map = Eigen::Isometry3d::Identity();
  T_map_map.linear() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_map_map.translation() << pose.x * target.cell_m, pose.y * target.cell_m, 0;
  if (shared.target.size() >= kMinCells) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& p : shared.target) middle += p;
    middle /= static_cast<double>(shared.target.size());
    Points at(shared.target.size());
    std::vector<double> difference_m(at.size());
    double squares = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] = shared.target[i] - middle;
      difference_m[i] = shared.target[i].z() - shared.source[i].z();
      squares += at[i].head<2>().squaredNorm();
    }
    const double scale_m = std::sqrt(squares / static_cast<double>(at.size()));
    const Eigen::Vector3d plane = scale_m > 0 ? fit_plane(at, difference_m, scale_m) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d normal = Eigen::Vector3d(-plane[1] / scale_m, -plane[2] / scale_m, 1).normalized();
    const Eigen::Vector3d about(middle.x(), middle.y(), middle.z() - plane[0]);
    const Eigen::Isometry3d tilt = Eigen::Translation3d(about + Eigen::Vector3d(0, 0, plane[0])) *
                                   Eigen::Isometry3d(rotation_between(Eigen::Vector3d::UnitZ(), normal)) *
                                   Eigen::Translation3d(-about);
    T_map_map = tilt * T_map_map;
  }
  return target.T_map_scan.inverse() * T_map_map * source.T_map_scan;
}

}  // namespace tcm_icp
