#pragma once
// Points in one frame, with or without normals.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tcm_icp/core/paged_allocator.hpp"

namespace tcm_icp {

/// Points or directions in one frame: a vector, whose memory may lie in a file where a set of scans has no room.
using Points = std::vector<Eigen::Vector3d, PagedAllocator<Eigen::Vector3d>>;

/// Points in one frame [m]. `normals` is empty or as long as `points`; a zero normal marks a point whose surface
/// direction could not be determined.
struct Cloud {
  Points points;   ///< [m]
  Points normals;  ///< of unit length or zero; empty: none

  std::size_t size() const { return points.size(); }  ///< number of points
  bool empty() const { return points.empty(); }       ///< whether there is no point
  /// Whether every point has a normal, be it zero.
  bool has_normals() const { return !points.empty() && normals.size() == points.size(); }
};

}  // namespace tcm_icp
