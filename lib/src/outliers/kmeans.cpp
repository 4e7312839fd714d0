#include "tcm_icp/outliers/kmeans.hpp"

#include <string>
#include <utility>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

// For each centroid the squared distance [m^2] below which it is the nearest for sure: half-way to the next one, less
// what rounding may add.
std::vector<double> own_spheres(const Points& centroids, const NeighborIndex& index) {
  std::vector<double> squared;
  squared.reserve(centroids.size());
  std::vector<Neighbor> two;
  for (const auto& c : centroids) {
    index.nearest_k(c, 2, two);
    squared.push_back(two.size() < 2 ? 0 : two[1].squared_distance_m2 / 4 * (1 - 1e-9));
  }
  return squared;
}

// Writes each point's cluster and distance. `again` where an earlier call has: most points stay where they are, and are
// spared the search.
void assign(const Points& points, bool again, KMeansResult& result, int num_threads) {
  const NeighborIndex index(result.centroids);
  const std::vector<double> own = again ? own_spheres(result.centroids, index) : std::vector<double>();
  parallel_for(num_threads, points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!points[i].allFinite()) throw InvalidInput("k-means was given a point that is not finite");
      if (again) {
        const std::uint32_t c = result.cluster[i];
        const double squared_m2 = squared_distance_m2(points[i], result.centroids[c]);
        if (squared_m2 < own[c]) {
          result.squared_distance_m2[i] = squared_m2;
          continue;
        }
      }
      const Neighbor n = index.nearest(points[i]);
      result.cluster[i] = n.index;
      result.squared_distance_m2[i] = n.squared_distance_m2;
    }
  });
}

void move_centroids(const Points& points, KMeansResult& result) {
  Points sum(result.centroids.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < points.size(); ++i) sum[result.cluster[i]] += points[i];
  for (std::size_t c = 0; c < sum.size(); ++c) {
    if (result.size[c] > 0) result.centroids[c] = sum[c] / static_cast<double>(result.size[c]);
  }
}

void count_sizes(KMeansResult& result) {
  result.size.assign(result.centroids.size(), 0);
  for (const std::uint32_t c : result.cluster) ++result.size[c];
}

}  // namespace

KMeansResult kmeans(const Points& points, const Points& initial_centroids, int max_iterations, int num_threads) {
  if (initial_centroids.empty()) throw InvalidInput("k-means needs at least one centroid to start from");
  if (max_iterations < 0) {
    throw InvalidOptions("max_iterations is " + std::to_string(max_iterations) + "; it must be at least 0");
  }
  KMeansResult result;
  result.centroids = initial_centroids;
  result.cluster.resize(points.size());
  result.squared_distance_m2.resize(points.size());
  assign(points, false, result, num_threads);
  count_sizes(result);
  while (!result.converged && result.num_iterations < max_iterations) {
    const std::vector<std::uint32_t> before = result.cluster;
    move_centroids(points, result);
    assign(points, true, result, num_threads);
    count_sizes(result);
    ++result.num_iterations;
    result.converged = result.cluster == before;
  }
  return result;
}

}  // namespace tcm_icp
