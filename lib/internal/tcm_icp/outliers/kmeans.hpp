#pragma once
// Lloyd's k-means from given centroids.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

struct KMeansResult {
  Points centroids;                         ///< as many as were given; one without points stays where it was
  std::vector<std::uint32_t> cluster;       ///< for each point its nearest centroid
  std::vector<double> squared_distance_m2;  ///< [m^2] for each point, to that centroid
  std::vector<std::size_t> size;            ///< points of each cluster
  int num_iterations = 0;                   ///< times the centroids were moved
  bool converged = false;                   ///< no point changed its cluster in the last iteration
};

/// Assigns each point to its nearest centroid and moves the centroids to their points' means, until nothing changes or
/// `max_iterations` is reached. Assignments and distances belong to the centroids returned. The same bits whatever the
/// number of threads.
/// @throws InvalidInput  if there are no centroids or a coordinate is not finite; InvalidOptions if max_iterations < 0
/// Cost O(N log k) an iteration.
KMeansResult kmeans(const Points& points, const Points& initial_centroids, int max_iterations, int num_threads);

}  // namespace tcm_icp
