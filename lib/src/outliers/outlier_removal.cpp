#include "tcm_icp/outliers/outlier_removal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "core/voxel_table.hpp"
#include "outliers/outlier_detectors.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/place_sampling.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

void require(bool holds, const char* field, double value, const char* bound) {
  if (!holds) {
    throw InvalidOptions(std::string(field) + " is " + std::to_string(value) + "; it must be " + bound);
  }
}

// Clusters and neighbourhoods are to weigh surface, not how often the scanner swept it: near the scanner a raw cloud is
// a thousand times denser than at its far end, which would then look like strays. Voxels of about the far end's spacing
// flatten that; 8,192 of them is a surface of 90 x 90.
constexpr std::size_t kMaxVoxels = 8192;
// A voxel on a surface holds many points, a stray point has one to itself: this many count.
constexpr int kMaxPointsPerVoxel = 4;

struct ThinnedCloud {
  Points points;  ///< the first few of each voxel
  std::size_t num_voxels;
  double voxel_size_m;  ///< the working cloud's times a power of two
};

ThinnedCloud thin(const Points& working_cloud, double voxel_size_m) {
  // Voxels that halve nest, so that nothing has to be remembered from one size to the next; dense ones end the count.
  std::size_t num_voxels = working_cloud.size();
  while (num_voxels > kMaxVoxels) {
    voxel_size_m *= 2;
    num_voxels = count_voxels(working_cloud, voxel_size_m, kMaxVoxels + 1);
  }
  VoxelTable table;
  std::vector<int> count;
  Points points;
  for (const auto& p : working_cloud) {
    const std::uint32_t voxel = table.find_or_insert(voxel_key(p, voxel_size_m));
    if (voxel == count.size()) count.push_back(0);
    if (count[voxel]++ < kMaxPointsPerVoxel) points.push_back(p);
  }
  return {std::move(points), num_voxels, voxel_size_m};
}

bool all_equal(const Points& points) {
  return std::all_of(points.begin(), points.end(), [&](const auto& p) { return p == points.front(); });
}

}  // namespace

struct OutlierRule::Impl {
  // kKMeans
  Points centroid_points;
  std::optional<NeighborIndex> centroids;
  double threshold_m = 0;
  // kDistance and kLof; membership only, so the order of a hash decides nothing
  std::unordered_set<VoxelKey, VoxelKeyHash> outlier_voxels;
  double voxel_size_m = 0;
};

OutlierRule::OutlierRule() = default;
OutlierRule::OutlierRule(std::shared_ptr<const Impl> impl, OutlierSummary summary)
    : impl_(std::move(impl)), summary_(summary) {}

OutlierRule::OutlierRule(const OutlierRuleState& state) : summary_(state.summary) {
  if (state.keeps_all) return;
  auto impl = std::make_shared<Impl>();
  impl->centroid_points = state.centroids;
  if (state.summary.method == OutlierMethod::kKMeans) impl->centroids.emplace(state.centroids);
  impl->threshold_m = state.threshold_m;
  impl->outlier_voxels.insert(state.voxels.begin(), state.voxels.end());
  impl->voxel_size_m = state.voxel_size_m;
  impl_ = impl;
}

OutlierRuleState OutlierRule::state() const {
  OutlierRuleState out;
  out.summary = summary_;
  out.keeps_all = impl_ == nullptr;
  if (out.keeps_all) return out;
  out.centroids = impl_->centroid_points;
  out.threshold_m = impl_->threshold_m;
  out.voxels.assign(impl_->outlier_voxels.begin(), impl_->outlier_voxels.end());
  std::sort(out.voxels.begin(), out.voxels.end(),
            [](const VoxelKey& a, const VoxelKey& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  out.voxel_size_m = impl_->voxel_size_m;
  return out;
}

bool OutlierRule::is_outlier(const Eigen::Vector3d& p) const {
  std::uint32_t near = 0;
  return is_outlier(p, near);
}

bool OutlierRule::is_outlier(const Eigen::Vector3d& p, std::uint32_t& near) const {
  if (!p.allFinite()) return true;
  if (!impl_) return false;
  if (impl_->centroids) {
    const Points& centroids = impl_->centroid_points;
    const double threshold_m = impl_->threshold_m;
    if (near < centroids.size() && squared_distance_m2(p, centroids[near]) <= threshold_m * threshold_m) return false;
    const Neighbor found = impl_->centroids->one_within(p, threshold_m);
    if (found.found()) near = found.index;
    return !found.found();
  }
  return !impl_->outlier_voxels.empty() && impl_->outlier_voxels.contains(voxel_key(p, impl_->voxel_size_m));
}

void OutlierOptions::validate() const {
  require(kmeans_clusters >= 0, "kmeans_clusters", kmeans_clusters, "at least 0");
  require(kmeans_radius_m >= 0 && std::isfinite(kmeans_radius_m), "kmeans_radius_m", kmeans_radius_m, "at least 0");
  require(kmeans_threshold_m >= 0 && std::isfinite(kmeans_threshold_m), "kmeans_threshold_m", kmeans_threshold_m,
          "at least 0");
  require(kmeans_max_iterations >= 0, "kmeans_max_iterations", kmeans_max_iterations, "at least 0");
  require(num_neighbors >= 2, "num_neighbors", num_neighbors, "at least 2");
  require(distance_factor > 1 && std::isfinite(distance_factor), "distance_factor", distance_factor, "above 1");
  require(lof_threshold > 1 && std::isfinite(lof_threshold), "lof_threshold", lof_threshold, "above 1");
}

namespace {

std::vector<std::size_t> neighborhood_outliers(const Points& points, const OutlierOptions& options, int num_threads,
                                               OutlierSummary& summary) {
  if (options.method == OutlierMethod::kDistance) {
    return detail::distance_outliers(points, options.num_neighbors, options.distance_factor, summary.threshold);
  }
  summary.threshold = options.lof_threshold;
  const std::vector<double> factors = detail::local_outlier_factors(points, options.num_neighbors, num_threads);
  std::vector<std::size_t> outliers;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i] > options.lof_threshold) outliers.push_back(i);
  }
  return outliers;
}

// Voxels all of whose points are outliers: raw points beside a surface are not lost with a stray one.
std::unordered_set<VoxelKey, VoxelKeyHash> outlier_voxels(const Points& points,
                                                          const std::vector<std::size_t>& outliers,
                                                          double voxel_size_m) {
  std::vector<bool> is_outlier(points.size(), false);
  std::unordered_set<VoxelKey, VoxelKeyHash> voxels;
  for (const std::size_t i : outliers) {
    is_outlier[i] = true;
    voxels.insert(voxel_key(points[i], voxel_size_m));
  }
  for (std::size_t i = 0; i < points.size() && !voxels.empty(); ++i) {
    if (!is_outlier[i]) voxels.erase(voxel_key(points[i], voxel_size_m));
  }
  return voxels;
}

}  // namespace

OutlierRule learn_outlier_rule(const Points& working_cloud, double voxel_size_m, const OutlierOptions& options,
                               Rng& rng, int num_threads) {
  options.validate();
  if (working_cloud.empty()) throw InvalidInput("outliers of an empty cloud cannot be told");
  for (const auto& p : working_cloud) {
    if (!p.allFinite()) throw InvalidInput("the working cloud has a point that is not finite");
  }
  OutlierSummary summary;
  summary.method = options.method;
  if (options.method == OutlierMethod::kNone || working_cloud.size() < 3 || all_equal(working_cloud)) {
    return OutlierRule(nullptr, summary);
  }

  if (!(voxel_size_m > 0)) throw InvalidInput("the working cloud's voxel size must be positive");
  const ThinnedCloud thinned = thin(working_cloud, voxel_size_m);
  auto impl = std::make_shared<OutlierRule::Impl>();
  if (options.method == OutlierMethod::kKMeans) {
    const auto order = draw_order(place_priorities(thinned.points, voxel_size_m, rng));
    const auto rule =
        detail::learn_kmeans_rule(thinned.points, thinned.num_voxels, order, options, num_threads, summary);
    impl->centroid_points = rule.centroids;
    impl->centroids.emplace(rule.centroids);
    impl->threshold_m = rule.threshold_m;
  } else {
    impl->voxel_size_m = thinned.voxel_size_m;
    impl->outlier_voxels = outlier_voxels(
        thinned.points, neighborhood_outliers(thinned.points, options, num_threads, summary), thinned.voxel_size_m);
  }
  const OutlierRule rule(impl, summary);
  std::uint32_t near = 0;
  for (const auto& p : working_cloud) summary.num_outliers += rule.is_outlier(p, near) ? 1 : 0;
  return OutlierRule(impl, summary);
}

}  // namespace tcm_icp
