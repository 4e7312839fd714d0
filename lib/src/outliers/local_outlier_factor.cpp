#include <algorithm>
#include <cmath>
#include <limits>

#include "outliers/outlier_detectors.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp::detail {
namespace {

// The k nearest other points of each point, row by row.
std::vector<Neighbor> neighbor_table(const Points& points, std::size_t k, int num_threads) {
  const NeighborIndex index(points);
  std::vector<Neighbor> table(points.size() * k);
  parallel_for(num_threads, points.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> nearest;
    for (std::size_t i = begin; i < end; ++i) {
      index.nearest_k(points[i], k + 1, nearest);
      // Among more than k duplicates the point itself may be missing: then the last one is dropped instead.
      const auto self = std::find_if(nearest.begin(), nearest.end(), [&](const Neighbor& n) { return n.index == i; });
      nearest.erase(self == nearest.end() ? std::prev(nearest.end()) : self);
      std::copy(nearest.begin(), nearest.end(), table.begin() + static_cast<std::ptrdiff_t>(i * k));
    }
  });
  return table;
}

}  // namespace

std::vector<double> local_outlier_factors(const Points& points, int num_neighbors, int num_threads) {
  const std::size_t k = std::min(static_cast<std::size_t>(num_neighbors), points.size() - 1);
  const std::vector<Neighbor> table = neighbor_table(points, k, num_threads);
  const auto k_distance = [&](std::size_t i) { return std::sqrt(table[i * k + k - 1].squared_distance_m2); };

  // Mean reachability distance; its reciprocal is the local reachability density.
  std::vector<double> reach(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    double sum = 0;
    for (std::size_t j = i * k; j < (i + 1) * k; ++j) {
      sum += std::max(std::sqrt(table[j].squared_distance_m2), k_distance(table[j].index));
    }
    reach[i] = sum / static_cast<double>(k);
  }

  std::vector<double> factor(points.size(), 1.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (reach[i] == 0) continue;
    double sum = 0;
    for (std::size_t j = i * k; j < (i + 1) * k; ++j)
      sum += reach[i] / reach[table[j].index];  // infinite by duplicates
    factor[i] = sum / static_cast<double>(k);
  }
  return factor;
}

}  // namespace tcm_icp::detail
