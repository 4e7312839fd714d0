#include "radius_neighbors.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

/// Points in the order of their cells, of one radius' edge; cells of a row along x follow one another.
class Grid {
 public:
  Grid(const Points& points, double edge_m) : keys_(points.size()), order_(points.size()) {
    std::vector<VoxelKey> unsorted(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) unsorted[i] = voxel_key(points[i], edge_m);
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tuple(before(unsorted[a]), a) < std::tuple(before(unsorted[b]), b);
    });
    for (std::size_t i = 0; i < order_.size(); ++i) {
      keys_[i] = unsorted[order_[i]];
      sorted_.push_back(points[order_[i]]);
    }
  }

  std::size_t size() const { return order_.size(); }
  std::uint32_t index(std::size_t position) const { return order_[position]; }
  const Eigen::Vector3d& point(std::size_t position) const { return sorted_[position]; }

  std::size_t end_of_cell(std::size_t position) const {
    const VoxelKey key = keys_[position];
    while (position < keys_.size() && keys_[position] == key) ++position;
    return position;
  }

  /// Positions of the 27 cells about the one of `position`, row by row.
  void gather_around(std::size_t position, std::vector<std::uint32_t>& out) const {
    out.clear();
    const VoxelKey key = keys_[position];
    for (std::int64_t z = key.z - 1; z <= key.z + 1; ++z) {
      for (std::int64_t y = key.y - 1; y <= key.y + 1; ++y) {
        auto at = std::lower_bound(keys_.begin(), keys_.end(), VoxelKey{key.x - 1, y, z}, less);
        for (; at != keys_.end() && at->z == z && at->y == y && at->x <= key.x + 1; ++at) {
          out.push_back(static_cast<std::uint32_t>(at - keys_.begin()));
        }
      }
    }
  }

 private:
  static std::tuple<std::int64_t, std::int64_t, std::int64_t> before(const VoxelKey& k) { return {k.z, k.y, k.x}; }
  static bool less(const VoxelKey& a, const VoxelKey& b) { return before(a) < before(b); }

  std::vector<VoxelKey> keys_;
  std::vector<std::uint32_t> order_;
  Points sorted_;
};

}  // namespace

RadiusNeighbors radius_neighbors(const Points& points, double radius_m) {
  const Grid grid(points, radius_m);
  const double squared_radius_m2 = radius_m * radius_m;
  // In the order of the grid first; the lists of the points are then copied to their places.
  std::vector<std::uint32_t> found, around, found_first(points.size() + 1, 0);
  for (std::size_t cell = 0; cell < grid.size();) {
    const std::size_t end = grid.end_of_cell(cell);
    grid.gather_around(cell, around);
    for (; cell < end; ++cell) {
      for (const std::uint32_t other : around) {
        if (other != cell && (grid.point(other) - grid.point(cell)).squaredNorm() <= squared_radius_m2) {
          found.push_back(grid.index(other));
        }
      }
      found_first[cell + 1] = static_cast<std::uint32_t>(found.size());
    }
  }
  RadiusNeighbors out{std::vector<std::uint32_t>(points.size() + 1, 0), std::vector<std::uint32_t>(found.size())};
  for (std::size_t k = 0; k < grid.size(); ++k) out.first[grid.index(k) + 1] = found_first[k + 1] - found_first[k];
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  for (std::size_t k = 0; k < grid.size(); ++k) {
    std::copy(found.begin() + found_first[k], found.begin() + found_first[k + 1],
              out.index.begin() + out.first[grid.index(k)]);
  }
  return out;
}

}  // namespace tcm_icp
