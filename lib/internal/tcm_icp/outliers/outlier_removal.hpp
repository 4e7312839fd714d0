#pragma once
// Which points of a scan are outliers: decided once on the bounded working cloud, then asked for every raw point.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"
#include "tcm_icp/outliers/outlier_method.hpp"

namespace tcm_icp {

/// Lengths and counts that are 0 are derived from the scan; docs/decisions/0005-outlier-threshold.md says how.
struct OutlierOptions {
  OutlierMethod method = OutlierMethod::kKMeans;
  int kmeans_clusters = 0;     ///< >= 0; k. 0: a sphere per 16 voxels tiles the surface, and what is left is seeded too
  double kmeans_radius_m = 0;  ///< [m] >= 0; sphere of the seeding
  double kmeans_threshold_m = 0;   ///< [m] >= 0; points farther than this from every centroid are outliers
  int kmeans_max_iterations = 10;  ///< >= 0
  int num_neighbors = 8;           ///< >= 2; of kDistance and kLof
  double distance_factor = 10;     ///< > 1; kDistance: rms distance to the neighbours, in typical spacings
  double lof_threshold = 4;        ///< > 1; kLof: 1 is as dense as the neighbours
  void validate() const;           ///< throws InvalidOptions
};

struct OutlierSummary {
  OutlierMethod method = OutlierMethod::kNone;
  std::size_t num_clusters = 0;         ///< kKMeans: centroids after the seeding
  std::size_t num_struck_clusters = 0;  ///< kKMeans: of these, too small to vouch for their own points
  double radius_m = 0;                  ///< [m] kKMeans
  double threshold = 0;                 ///< kKMeans, kDistance: [m]; kLof: a ratio
  int num_iterations = 0;               ///< kKMeans
  std::size_t num_outliers = 0;         ///< points of the working cloud
};

/// A rule as plain values, to be kept.
struct OutlierRuleState {
  bool keeps_all = true;
  Points centroids;              ///< kKMeans; empty for the others
  double threshold_m = 0;        ///< kKMeans
  std::vector<VoxelKey> voxels;  ///< kDistance, kLof: whose points are outliers, in ascending order
  double voxel_size_m = 0;       ///< kDistance, kLof
  OutlierSummary summary;
};

/// A decision about points in the frame of the working cloud it was learned from. Copies share one state. Thread-safe.
class OutlierRule {
 public:
  struct Impl;

  /// The rule that keeps every point.
  OutlierRule();
  OutlierRule(std::shared_ptr<const Impl> impl, OutlierSummary summary);
  /// The rule that had this state.
  explicit OutlierRule(const OutlierRuleState& state);

  /// kKMeans: O(log k); otherwise one look-up. A point that is not finite is an outlier.
  bool is_outlier(const Eigen::Vector3d& p) const;
  /// The same for point after point along surfaces, most of which are spared the search.
  /// @param near  what the call before left there; 0 at first
  bool is_outlier(const Eigen::Vector3d& p, std::uint32_t& near) const;
  const OutlierSummary& summary() const { return summary_; }
  OutlierRuleState state() const;

 private:
  std::shared_ptr<const Impl> impl_;
  OutlierSummary summary_;
};

/// Learns the rule from the working cloud: one mean point per voxel.
///
/// All methods look at a thinned cloud: voxels of voxel_size_m * 2^n, at most 8,192 of them and four points in each, so
/// that surface counts and not how often the scanner swept it: a sparse far end is no outlier.
/// - kKMeans: outlier = farther than the threshold from every centroid that counts. A stray point can become its own
///   centroid, at distance 0; so a cluster with fewer than a twentieth of the points of a typical one is struck off,
///   and its points are judged by the next centroid.
/// - kDistance, kLof: what falls into a voxel is an outlier where all the points learned from in it are.
///
/// @param voxel_size_m  [m] edge of the working cloud's voxels
/// @throws InvalidInput  if the cloud is empty or not finite, or the voxel size is not positive
/// @throws InvalidOptions
/// A cloud of fewer than 3 points, or of equal points, has no outliers, whatever its voxel size. Cost O(N log N); the
/// result does not depend on num_threads.
OutlierRule learn_outlier_rule(const Points& working_cloud, double voxel_size_m, const OutlierOptions& options,
                               Rng& rng, int num_threads);

}  // namespace tcm_icp
