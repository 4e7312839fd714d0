#include "tcm_icp/coarse/scan_features.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/pick.hpp"
#include "fpfh_of_neighbors.hpp"
#include "local_normals.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

// The described points, the least common first.
std::vector<std::uint32_t> by_distinctness(const Descriptors& descriptors) {
  std::vector<std::uint32_t> order;
  Eigen::Matrix<float, kFpfhSize, 1> common = Eigen::Matrix<float, kFpfhSize, 1>::Zero();
  for (Eigen::Index i = 0; i < descriptors.cols(); ++i) {
    if (descriptors.col(i).isZero(0)) continue;
    order.push_back(static_cast<std::uint32_t>(i));
    common += descriptors.col(i);
  }
  const Eigen::VectorXf likeness = descriptors.transpose() * common;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return likeness[a] != likeness[b] ? likeness[a] < likeness[b] : a < b;
  });
  return order;
}

// The first ones that keep their distance from one another, in the order of the points.
std::vector<std::uint32_t> spread(const std::vector<std::uint32_t>& order, const Points& points,
                                  const RadiusNeighbors& neighbors, double spacing_m, std::size_t count) {
  std::vector<char> blocked(points.size(), 0);
  std::vector<std::uint32_t> chosen;
  for (const std::uint32_t i : order) {
    if (chosen.size() == count) break;
    if (blocked[i] != 0) continue;
    chosen.push_back(i);
    for (const std::uint32_t j : neighbors.of(i)) {
      if ((points[j] - points[i]).squaredNorm() < spacing_m * spacing_m) blocked[j] = 1;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

void FeatureOptions::validate() const {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw InvalidOptions(what);
  };
  require(radius_voxels > 1, "radius_voxels must be above 1, not " + std::to_string(radius_voxels));
  require(
      normal_radius_voxels > 1 && normal_radius_voxels <= radius_voxels,
      "normal_radius_voxels must be above 1 and at most radius_voxels, not " + std::to_string(normal_radius_voxels));
  require(keypoint_spacing_voxels >= 0 && keypoint_spacing_voxels <= radius_voxels,
          "keypoint_spacing_voxels must be 0 to radius_voxels, not " + std::to_string(keypoint_spacing_voxels));
  require(max_keypoints >= 1, "max_keypoints must be at least 1, not " + std::to_string(max_keypoints));
}

ScanFeatures find_features(const PyramidLevel& level, const FeatureOptions& options) {
  options.validate();
  const double voxel = level.voxel_size_m;
  const Points& points = level.cloud.points;
  const RadiusNeighbors neighbors = radius_neighbors(points, options.radius_voxels * voxel);
  const Cloud cloud{points, local_normals(points, neighbors, options.normal_radius_voxels * voxel)};
  const Descriptors all = fpfh(cloud, neighbors, options.radius_voxels * voxel);
  const auto chosen = spread(by_distinctness(all), points, neighbors, options.keypoint_spacing_voxels * voxel,
                             static_cast<std::size_t>(options.max_keypoints));
  ScanFeatures out{voxel, pick(cloud, chosen), Descriptors(kFpfhSize, static_cast<Eigen::Index>(chosen.size()))};
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    out.descriptors.col(static_cast<Eigen::Index>(k)) = all.col(chosen[k]);
  }
  return out;
}

}  // namespace tcm_icp
