#include "tcm_icp/outliers/kmeans_seeding.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kRadiusSamples = 4096;
constexpr double kCoveredShare = 0.5;

// Spread of the sample: an upper end for the radius, where one sphere holds everything.
double largest_distance_from_mean(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double squared = 0;
  for (const auto& p : points) squared = std::max(squared, (p - mean).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace

KMeansSeeds seed_kmeans(const Points& points, const NeighborIndex& index, double radius_m, std::size_t max_centroids,
                        std::span<const std::size_t> order) {
  if (!(radius_m > 0))
    throw InvalidOptions("the seeding radius is " + std::to_string(radius_m) + "; it must be positive");
  if (max_centroids == 0) throw InvalidOptions("the number of clusters is 0; it must be at least 1");
  KMeansSeeds seeds;
  std::vector<bool> is_taken(points.size(), false);
  std::vector<Neighbor> sphere;
  const auto take = [&](std::size_t i) {
    if (!is_taken[i]) ++seeds.num_covered;
    is_taken[i] = true;
  };
  for (const std::size_t seed : order) {
    if (is_taken[seed]) continue;
    if (seeds.centroids.size() == max_centroids) break;
    seeds.centroids.push_back(points[seed]);
    index.within_unordered(points[seed], radius_m, sphere);
    for (const auto& n : sphere) take(n.index);
    take(seed);
  }
  return seeds;
}

double seeding_radius(const Points& points, std::size_t num_clusters, std::span<const std::size_t> order) {
  Points sample;
  for (const std::size_t i : order.first(std::min(order.size(), kRadiusSamples))) sample.push_back(points[i]);
  std::vector<std::size_t> drawn(sample.size());
  std::iota(drawn.begin(), drawn.end(), std::size_t{0});
  const double spread = sample.empty() ? 0 : largest_distance_from_mean(sample);
  if (!(spread > 0)) throw InvalidInput("a cloud whose points are all equal has no length to derive a radius from");
  const NeighborIndex index(sample);
  const auto share_of = [](std::size_t n) {
    return static_cast<std::size_t>(std::ceil(kCoveredShare * static_cast<double>(n)));
  };
  const std::size_t wanted = share_of(sample.size());
  // From above: far fewer spheres to draw than from below. Twice the spread reaches from any point to any other.
  double radius = 2 * spread;
  for (double smaller = radius; smaller > 0; smaller *= std::exp2(-0.25)) {
    if (seed_kmeans(sample, index, smaller, share_of(num_clusters), drawn).num_covered < wanted) break;
    radius = smaller;
  }
  return radius;
}

}  // namespace tcm_icp
