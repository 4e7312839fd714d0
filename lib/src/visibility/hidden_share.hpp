#pragma once
// Share of a scan's points that others hide from a place.

#include <Eigen/Core>
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
  /// Keeps a reference to the cloud.
  HiddenShare(const UnitCloud& cloud, double bins_per_point);

  /// 0..1; O(N), about 10 ns a point.
  double operator()(const Eigen::Vector3f& place);

 private:
  bool apart(std::size_t point, std::size_t nearer, float gap) const;

  const UnitCloud& cloud_;
  DirectionBins bins_;
  std::vector<std::int32_t> bin_;      // of each point, from the place looked from
  std::vector<float> range_;           // and its distance
  std::vector<std::int32_t> nearest_;  // point of each bin; -1: none
};

}  // namespace tcm_icp
