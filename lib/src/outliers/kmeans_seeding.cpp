#include "tcm_icp/outliers/kmeans_seeding.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/even_sample.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kRadiusSamples = 4096;
constexpr double kCoveredShare = 0.5;

// Indices that are still there; drawing and taking away cost O(1).
class RemainingPoints {
 public:
  explicit RemainingPoints(std::size_t count) : indices_(count), place_(count) {
    std::iota(indices_.begin(), indices_.end(), 0u);
    std::iota(place_.begin(), place_.end(), 0u);
  }
  bool empty() const { return indices_.empty(); }
  std::size_t size() const { return indices_.size(); }
  std::uint32_t draw(Rng& rng) const { return indices_[uniform_index(rng, indices_.size())]; }
  void take(std::uint32_t index) {
    const std::uint32_t place = place_[index];
    if (place == kTaken) return;
    const std::uint32_t last = indices_.back();
    indices_[place] = last;
    place_[last] = place;
    indices_.pop_back();
    place_[index] = kTaken;
  }

 private:
  static constexpr std::uint32_t kTaken = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> place_;
};

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
                        Rng& rng) {
  if (!(radius_m > 0))
    throw InvalidOptions("the seeding radius is " + std::to_string(radius_m) + "; it must be positive");
  if (max_centroids == 0) throw InvalidOptions("the number of clusters is 0; it must be at least 1");
  KMeansSeeds seeds;
  RemainingPoints remaining(points.size());
  std::vector<Neighbor> sphere;
  while (!remaining.empty() && seeds.centroids.size() < max_centroids) {
    const std::uint32_t seed = remaining.draw(rng);
    seeds.centroids.push_back(points[seed]);
    index.within(points[seed], radius_m, sphere);
    for (const auto& n : sphere) remaining.take(n.index);
    remaining.take(seed);
  }
  seeds.num_covered = points.size() - remaining.size();
  return seeds;
}

double seeding_radius(const Points& points, std::size_t num_clusters, Rng& rng) {
  const Points sample = even_sample(points, kRadiusSamples);
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
    if (seed_kmeans(sample, index, smaller, share_of(num_clusters), rng).num_covered < wanted) break;
    radius = smaller;
  }
  return radius;
}

}  // namespace tcm_icp
