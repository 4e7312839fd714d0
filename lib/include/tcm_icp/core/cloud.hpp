#pragma once
// Points in one frame, with or without normals.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tcm_icp {

using Points = std::vector<Eigen::Vector3d>;

/// Points in one frame [m]. `normals` is empty or as long as `points`; a zero normal marks a point whose surface
/// direction could not be determined.
struct Cloud {
  Points points;
  Points normals;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
  bool has_normals() const { return !points.empty() && normals.size() == points.size(); }
};

}  // namespace tcm_icp
