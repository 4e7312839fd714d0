#pragma once
// Some points of a cloud, by their indices.

#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// The points of the indices, in their order, with their normals.
/// @pre the cloud has normals
template <typename Index>
Cloud pick(const Cloud& cloud, const std::vector<Index>& indices) {
  Cloud out;
  out.points.reserve(indices.size());
  out.normals.reserve(indices.size());
  for (const Index i : indices) {
    out.points.push_back(cloud.points[i]);
    out.normals.push_back(cloud.normals[i]);
  }
  return out;
}

}  // namespace tcm_icp
