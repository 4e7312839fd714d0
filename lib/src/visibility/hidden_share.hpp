#pragma once
// Share of a scan's points that others hide from a place.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "direction_bins.hpp"
#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// A scan without unit: its own axes, its middle edge as the unit of length.
struct UnitCloud {
  std::vector<float> x, y, z;     ///< points
  std::vector<float> nx, ny, nz;  ///< normals; zero where there is none

  std::size_t size() const { return x.size(); }
  /// Every so-manieth point, `count` of them at most, evenly spaced in their order.
  UnitCloud thinned(std::size_t count) const;
};

/// A point is hidden where a clearly nearer point of another surface lies in its bin of directions. Not thread-safe:
/// an object keeps what a look needs.
class HiddenShare {
 public:
  /// Copies what it needs. O(N log N).
  HiddenShare(const UnitCloud& cloud, double bins_per_point);

  /// @param at_most  no more need be known of larger shares than that they are larger
  /// @return         0..1, exact up to `at_most`; of larger ones, some share above it and not above the exact one
  /// O(N), about 5 ns a point.
  double operator()(const Eigen::Vector3f& place, double at_most = 1);

  /// Share of the points amid what others hide: in the bins on either side, left and right or above and below, too.
  /// From the place of a scanner the bins that edges cross hide points, which says how fine the bins are and not how
  /// far off the place is; these are hardly any there. O(N).
  double inner(const Eigen::Vector3f& place);

 private:
  struct Surface {
    float x, y, z, nx, ny, nz;
  };

  // Neither lies on the other's tangent plane: a floor seen at a low angle fills a bin at many distances.
  static bool apart(const Surface& p, const Surface& q, float gap) {
    const float dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z;
    return std::abs(dx * p.nx + dy * p.ny + dz * p.nz) > gap && std::abs(dx * q.nx + dy * q.ny + dz * q.nz) > gap;
  }

  void look_from(const Eigen::Vector3f& place);  // fills bin_, range_ and nearest_
  // Whether what is nearest in a bin hides the i-th point, in the order of the bins.
  bool hides(std::size_t bin, std::size_t i) const;

  DirectionBins bins_;
  std::vector<Surface> surfaces_;  // in the cloud's order
  // Points in an order in which neighbours in space follow one another: their bins, too, lie close together, from
  // wherever one looks, and stay in the cache.
  std::vector<std::uint32_t> index_;  // in the cloud
  std::vector<float> x_, y_, z_;
  std::vector<std::int32_t> bin_;       // of each, from the place looked from
  std::vector<float> range_;            // and its distance
  std::vector<std::uint64_t> nearest_;  // of each bin: range, as bits, before the index of the point
};

}  // namespace tcm_icp
