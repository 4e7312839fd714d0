#pragma once
// Nearest neighbours in a fixed set of points (CGAL's kd-tree, hidden).

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace tcm_icp {

struct Neighbor {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  double squared_distance_m2 = std::numeric_limits<double>::infinity();

  bool found() const { return squared_distance_m2 < std::numeric_limits<double>::infinity(); }
};

/// [m^2], summed as the index sums it, so that both find the same bits.
inline double squared_distance_m2(const Eigen::Vector3d& query, const Eigen::Vector3d& point) {
  const double x = query.x() - point.x(), y = query.y() - point.y(), z = query.z() - point.z();
  return x * x + y * y + z * z;
}

/// A kd-tree over a copy of `points`. Built in the constructor, so every query is const and thread-safe. Answers are
/// exact and depend on the points alone: of equally near points the one with the lowest index counts as nearer. A query
/// that is not finite finds nothing.
/// Cost: O(N log N) to build, O(log N) expected a query; 32 bytes a point, twice that while it is built.
class NeighborIndex {
 public:
  /// @throws InvalidInput  if a coordinate is not finite, or there are more than 4,000,000,000 points
  explicit NeighborIndex(std::span<const Eigen::Vector3d> points);
  ~NeighborIndex();
  NeighborIndex(const NeighborIndex&);
  NeighborIndex(NeighborIndex&&) noexcept;
  NeighborIndex& operator=(NeighborIndex&&) noexcept;

  std::size_t size() const;

  /// The nearest point; not found() where the index is empty.
  Neighbor nearest(const Eigen::Vector3d& query) const;

  /// The nearest point within `radius_m`; not found() where there is none. The search starts at the radius, so a miss
  /// is cheap.
  Neighbor nearest_within(const Eigen::Vector3d& query, double radius_m) const;

  /// Whether a point lies within `radius_m`: ends at the first one.
  bool any_within(const Eigen::Vector3d& query, double radius_m) const;

  /// A point within `radius_m`, whichever comes first; not found() where there is none.
  Neighbor one_within(const Eigen::Vector3d& query, double radius_m) const;

  /// Up to k nearest points, by distance and then index.
  void nearest_k(const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& out) const;

  /// The same of an index that holds k points within `radius_m`: the less that is, the less is searched.
  void nearest_k_within(const Eigen::Vector3d& query, std::size_t k, double radius_m, std::vector<Neighbor>& out) const;

  /// All points within `radius_m`, by distance and then index.
  void within(const Eigen::Vector3d& query, double radius_m, std::vector<Neighbor>& out) const;

  /// The same in no order.
  void within_unordered(const Eigen::Vector3d& query, double radius_m, std::vector<Neighbor>& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
