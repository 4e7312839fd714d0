#pragma once
// Nearest neighbours for PCL's methods by NeighborIndex in place of FLANN, which enters a parallel region for each
// query and leaves it by a system call. Answers are the same, both being exact, but for equally near points.

#include <pcl/point_cloud.h>
#include <pcl/search/kdtree.h>

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

/// Of the points of one cloud, in its unit; thread-safe queries.
template <typename Point>
std::shared_ptr<const NeighborIndex> index_of(const pcl::PointCloud<Point>& cloud) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(cloud.size());
  for (const Point& p : cloud) points.emplace_back(p.x, p.y, p.z);
  return std::make_shared<const NeighborIndex>(points);
}

/// Asked by PCL as its own tree is. `reach` [unit of the cloud]: a nearest point farther away may be left out, because
/// the caller would; it is then said to be infinitely far.
template <typename Point>
class PclSearch : public pcl::search::KdTree<Point> {
 public:
  using Base = pcl::search::KdTree<Point>;
  using Base::nearestKSearch;
  using Base::radiusSearch;

  explicit PclSearch(std::shared_ptr<const NeighborIndex> index, double reach = std::numeric_limits<double>::infinity())
      : index_(std::move(index)), reach_(reach) {}

  /// The index is that of the cloud already.
  void setInputCloud(const typename Base::PointCloudConstPtr& cloud,
                     const typename Base::IndicesConstPtr& indices = {}) override {
    this->input_ = cloud;
    this->indices_ = indices;
  }

  int nearestKSearch(const Point& point, int k, pcl::Indices& indices,
                     std::vector<float>& squared_distances) const override {
    std::vector<Neighbor> found;
    if (k == 1) {
      found.push_back(index_->nearest_within(query(point), reach_));
    } else {
      index_->nearest_k(query(point), static_cast<std::size_t>(k), found);
    }
    return give(found, indices, squared_distances);
  }

  int radiusSearch(const Point& point, double radius, pcl::Indices& indices, std::vector<float>& squared_distances,
                   unsigned int most = 0) const override {
    std::vector<Neighbor> found;
    index_->within(query(point), radius, found);
    if (most > 0 && found.size() > most) found.resize(most);
    return give(found, indices, squared_distances);
  }

 private:
  static Eigen::Vector3d query(const Point& p) { return {p.x, p.y, p.z}; }

  // PCL looks at the first distance without asking how many there are.
  static int give(const std::vector<Neighbor>& found, pcl::Indices& indices, std::vector<float>& squared_distances) {
    indices.clear();
    squared_distances.clear();
    int count = 0;
    for (const Neighbor& n : found) {
      indices.push_back(n.found() ? static_cast<pcl::index_t>(n.index) : 0);
      squared_distances.push_back(static_cast<float>(n.squared_distance_m2));
      if (n.found()) ++count;
    }
    return count;
  }

  std::shared_ptr<const NeighborIndex> index_;
  double reach_;
};

}  // namespace tcm_icp
