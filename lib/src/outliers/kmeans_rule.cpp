#include <algorithm>
#include <cmath>

#include "outliers/outlier_detectors.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/outliers/kmeans.hpp"
#include "tcm_icp/outliers/kmeans_seeding.hpp"

namespace tcm_icp::detail {
namespace {

constexpr double kVoxelsPerCluster = 16;  // four by four on a surface: enough to tell it from a stray
constexpr double kStruckShare = 0.05;     // of a typical cluster's points; and always a single point
constexpr double kFenceMads = 8;          // in standard deviations, were the distances normal

// Median + 8 robust standard deviations of the points' distances to their centroids: beyond twice the seeding radius.
double distance_fence(const KMeansResult& clusters) {
  std::vector<double> distances;
  for (const double squared : clusters.squared_distance_m2) distances.push_back(std::sqrt(squared));
  const double middle = median(distances);
  for (double& d : distances) d = std::abs(d - middle);
  return middle + kFenceMads * kMadToSigma * median(distances);
}

// The size of the cluster that a random point lies in; clusters of single stray points do not pull it down.
double typical_size(const std::vector<std::size_t>& sizes) {
  double sum = 0, sum_of_squares = 0;
  for (const std::size_t n : sizes) {
    sum += static_cast<double>(n);
    sum_of_squares += static_cast<double>(n) * static_cast<double>(n);
  }
  return sum_of_squares / sum;
}

}  // namespace

KMeansRule learn_kmeans_rule(const Points& points, std::size_t num_voxels, std::span<const std::size_t> order,
                             const OutlierOptions& options, int num_threads, OutlierSummary& summary) {
  const bool derive_k = options.kmeans_clusters == 0;
  const double tiles = std::ceil(static_cast<double>(num_voxels) / kVoxelsPerCluster);
  const auto k = derive_k ? static_cast<std::size_t>(tiles) : static_cast<std::size_t>(options.kmeans_clusters);
  summary.radius_m = options.kmeans_radius_m > 0 ? options.kmeans_radius_m : seeding_radius(points, k, order);

  const NeighborIndex index(points);
  const KMeansSeeds seeds = seed_kmeans(points, index, summary.radius_m, derive_k ? points.size() : k, order);
  const KMeansResult clusters = kmeans(points, seeds.centroids, options.kmeans_max_iterations, num_threads);

  KMeansRule rule;
  rule.threshold_m = options.kmeans_threshold_m > 0 ? options.kmeans_threshold_m : distance_fence(clusters);
  const double least = std::max(2.0, kStruckShare * typical_size(clusters.size));
  for (std::size_t c = 0; c < clusters.centroids.size(); ++c) {
    if (static_cast<double>(clusters.size[c]) >= least) rule.centroids.push_back(clusters.centroids[c]);
  }
  summary.num_clusters = clusters.centroids.size();
  summary.num_struck_clusters = clusters.centroids.size() - rule.centroids.size();
  summary.threshold = rule.threshold_m;
  summary.num_iterations = clusters.num_iterations;
  return rule;
}

}  // namespace tcm_icp::detail
