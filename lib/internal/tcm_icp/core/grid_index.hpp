#pragma once
// Nearest neighbours within a radius among points that lie about evenly, by a grid of cells.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/paged_allocator.hpp"

namespace tcm_icp {

/// What NeighborIndex finds, bit for bit, by cell lists: of voxel-sampled surfaces a cell of five voxels holds some 25
/// points, and a query asks one or two cells where a kd-tree goes down ten levels and looks into several leaves. Of
/// points that lie in heaps, or for radii above a cell, a kd-tree is faster. Queries are const and thread-safe.
/// Cost: O(N) to build, O(points about the query) a query; 28 bytes a point, and 21 to 43 for each cell that holds or
/// touches one that does.
class GridIndex {
 public:
  /// @param points  finite
  /// @param cell_m  > 0; edge of a cell, the largest radius that is fast
  /// @throws InvalidInput  if a coordinate is not finite, or there are more than 4,000,000,000 points;
  ///         InvalidOptions  if the cell has no edge, or one too short or long to be divided by
  GridIndex(std::span<const Eigen::Vector3d> points, double cell_m);

  std::size_t size() const { return keys_.size(); }

  /// The nearest point within `radius_m`, of equally near ones that with the lowest index; not found() where there is
  /// none, or where the query is not finite.
  Neighbor nearest_within(const Eigen::Vector3d& query, double radius_m) const;

 private:
  /// Places wrap around after 1024 cells an axis: what shares a cell then is seen to be far when it is looked at.
  struct Cell {
    std::uint32_t place = 0;
    std::uint32_t occupied = 0;        ///< of the 27 cells about, itself first, a bit each; 0: none is here
    std::uint32_t begin = 0, end = 0;  ///< points
  };
  using Place = std::array<std::int64_t, 3>;

  Place place_of(const Eigen::Vector3d& offset) const;
  std::size_t slot_of(std::uint32_t place) const;
  Cell& add(std::uint32_t place);
  void grow();
  void look_into(const Cell& cell, const Eigen::Vector3d& query, Neighbor& best) const;
  void look_farther(const Place& own, const Eigen::Vector3d& query, double radius_m, Neighbor& best) const;

  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), extent_ = Eigen::Vector3d::Zero();
  double cell_m_ = 0, cells_per_m_ = 0, slack_m_ = 0;
  std::uint32_t num_cells_ = 0;
  int shift_ = 32;                                                          ///< of a hash, to a slot
  std::vector<Cell, PagedAllocator<Cell>> cells_;                           ///< open addressing, linear probing
  std::vector<std::uint32_t, PagedAllocator<std::uint32_t>> keys_;          ///< of points, cell by cell
  std::array<std::vector<double, PagedAllocator<double>>, 3> coordinates_;  ///< of an axis each, as keys
};

}  // namespace tcm_icp
