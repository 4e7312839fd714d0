#pragma once
// One face for the kd-trees that are compared. Distances are in metres; negative where there is no neighbour.

#include <cmath>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

#ifdef TCM_ICP_HAVE_NANOFLANN
#include <nanoflann.hpp>
#endif
#ifdef TCM_ICP_HAVE_PCL
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#endif

namespace tcm_icp {

class TcmIcpIndex {
 public:
  explicit TcmIcpIndex(const Points& points) : index_(points) {}

  double nearest(const Eigen::Vector3d& q) const { return std::sqrt(index_.nearest(q).squared_distance_m2); }
  double nearest_within(const Eigen::Vector3d& q, double radius_m) const {
    const Neighbor n = index_.nearest_within(q, radius_m);
    return n.found() ? std::sqrt(n.squared_distance_m2) : -1;
  }
  double farthest_of_nearest_k(const Eigen::Vector3d& q, std::size_t k) {
    index_.nearest_k(q, k, found_);
    return std::sqrt(found_.back().squared_distance_m2);
  }

 private:
  NeighborIndex index_;
  std::vector<Neighbor> found_;
};

#ifdef TCM_ICP_HAVE_NANOFLANN
/// Doubles, and leaves of 20 points: of 10, 20 and 40 the fastest to query on the whole.
class NanoflannIndex {
 public:
  explicit NanoflannIndex(const Points& points)
      : adaptor_{points}, tree_(3, adaptor_, nanoflann::KDTreeSingleIndexAdaptorParams(20)) {}

  double nearest(const Eigen::Vector3d& q) const { return nearest_within(q, 1e9); }
  double nearest_within(const Eigen::Vector3d& q, double radius_m) const {
    std::uint32_t index = 0;
    double squared_m2 = 0;
    nanoflann::KNNResultSet<double, std::uint32_t> result(1);
    result.init(&index, &squared_m2);
    squared_m2 = radius_m * radius_m;  // the worst distance it accepts
    tree_.findNeighbors(result, q.data(), nanoflann::SearchParams());
    return result.size() > 0 ? std::sqrt(squared_m2) : -1;
  }
  double farthest_of_nearest_k(const Eigen::Vector3d& q, std::size_t k) {
    indices_.resize(k);
    squared_m2_.resize(k);
    nanoflann::KNNResultSet<double, std::uint32_t> result(k);
    result.init(indices_.data(), squared_m2_.data());
    tree_.findNeighbors(result, q.data(), nanoflann::SearchParams());
    return std::sqrt(squared_m2_.back());
  }

 private:
  struct Adaptor {
    const Points& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::uint32_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  Adaptor adaptor_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Adaptor>, Adaptor, 3, std::uint32_t> tree_;
  std::vector<std::uint32_t> indices_;
  std::vector<double> squared_m2_;
};
#endif

#ifdef TCM_ICP_HAVE_PCL
/// Floats, as PCL's points are; the tree sorts its answers, which for one neighbour costs nothing.
class PclIndex {
 public:
  explicit PclIndex(const Points& points) {
    const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    cloud->reserve(points.size());
    for (const auto& p : points) cloud->push_back(to_pcl(p));
    tree_.setInputCloud(cloud);
  }

  double nearest(const Eigen::Vector3d& q) const { return farthest(q, 1, indices_, squared_m2_); }
  double farthest_of_nearest_k(const Eigen::Vector3d& q, std::size_t k) {
    return farthest(q, k, indices_, squared_m2_);
  }

 private:
  static pcl::PointXYZ to_pcl(const Eigen::Vector3d& p) {
    const Eigen::Vector3f f = p.cast<float>();
    return {f.x(), f.y(), f.z()};
  }
  double farthest(const Eigen::Vector3d& q, std::size_t k, pcl::Indices& indices, std::vector<float>& squared) const {
    tree_.nearestKSearch(to_pcl(q), static_cast<unsigned>(k), indices, squared);
    return std::sqrt(static_cast<double>(squared.back()));
  }

  pcl::KdTreeFLANN<pcl::PointXYZ> tree_;
  mutable pcl::Indices indices_;
  mutable std::vector<float> squared_m2_;
};
#endif

}  // namespace tcm_icp
