#pragma once
// The two detectors that judge each point by its neighbours, and the clusters that judge by distance.

#include <span>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/outliers/outlier_removal.hpp"

namespace tcm_icp::detail {

struct KMeansRule {
  Points centroids;  ///< those that count
  double threshold_m = 0;
};

/// `points` of capped density lie in `num_voxels` voxels; centroids are drawn in `order`. Fills the summary's clusters,
/// radius, threshold and iterations.
KMeansRule learn_kmeans_rule(const Points& points, std::size_t num_voxels, std::span<const std::size_t> order,
                             const OutlierOptions& options, int num_threads, OutlierSummary& summary);

/// Indices whose root mean square distance to their `num_neighbors` nearest (the point itself among them, as CGAL
/// counts) is `factor` average spacings or more, ascending. Writes the threshold [m]. Needs >= 3 points that are not
/// all equal.
std::vector<std::size_t> distance_outliers(const Points& points, int num_neighbors, double factor, double& threshold_m);

/// Local outlier factor of each point (Breunig et al., SIGMOD 2000): mean density of its neighbours over its own. 1
/// inside a cluster of any density; a point among more than k duplicates has infinite density and counts as 1. Needs >=
/// 2 points.
std::vector<double> local_outlier_factors(const Points& points, int num_neighbors, int num_threads);

}  // namespace tcm_icp::detail
