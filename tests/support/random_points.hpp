#pragma once
// Points for property tests, where the shape does not matter.

#include <utility>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp::testing {

/// Uniform in a cube of edge `edge_m` about the origin.
inline Points random_points(std::size_t count, double edge_m, Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = uniform01(rng), y = uniform01(rng), z = uniform01(rng);
    points.emplace_back(Eigen::Vector3d(x, y, z) * edge_m - Eigen::Vector3d::Constant(edge_m / 2));
  }
  return points;
}

/// The same points in a random order.
inline Points shuffled(Points points, Rng& rng) {
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[uniform_index(rng, i)]);
  return points;
}

/// Same points scaled about the origin.
inline Points scaled(Points points, double factor) {
  for (auto& p : points) p *= factor;
  return points;
}

}  // namespace tcm_icp::testing
