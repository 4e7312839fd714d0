#include "unit_frame.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/decompositions.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// Stray points must not stretch the box.
constexpr double kLowShare = 0.03, kHighShare = 0.97;

Eigen::Isometry3d principal_axes(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose();
  Eigen::Matrix3d axes = symmetric_eigen3(covariance).vectors;
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = axes;
  T.translation() = mean;
  return T;
}

}  // namespace

std::optional<UnitFrame> find_unit_frame(const Cloud& cloud, std::size_t count, std::size_t least, Rng& rng) {
  if (!cloud.has_normals()) return std::nullopt;
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.normals[i].isZero()) usable.push_back(i);
  }
  if (usable.size() < least) return std::nullopt;
  Points points, normals;
  for (const std::size_t k : sample_indices(rng, usable.size(), count)) {
    points.push_back(cloud.points[usable[k]]);
    normals.push_back(cloud.normals[usable[k]]);
  }
  UnitFrame frame;
  frame.T_cloud_axes = principal_axes(points);
  const Eigen::Isometry3d T_axes_cloud = frame.T_cloud_axes.inverse();
  for (auto& p : points) p = T_axes_cloud * p;
  Eigen::Vector3d low, high;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][axis];
    low[axis] = quantile(values, kLowShare);
    high[axis] = quantile(values, kHighShare);
  }
  std::array<double, 3> edges{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::sort(edges.begin(), edges.end());
  frame.unit_m = edges[1];
  if (!(frame.unit_m > 0)) return std::nullopt;
  frame.box = {(low / frame.unit_m).cast<float>(), (high / frame.unit_m).cast<float>()};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = (points[i] / frame.unit_m).cast<float>();
    const Eigen::Vector3f n = (T_axes_cloud.linear() * normals[i]).cast<float>();
    frame.cloud.x.push_back(p.x()), frame.cloud.y.push_back(p.y()), frame.cloud.z.push_back(p.z());
    frame.cloud.nx.push_back(n.x()), frame.cloud.ny.push_back(n.y()), frame.cloud.nz.push_back(n.z());
  }
  return frame;
}

}  // namespace tcm_icp
