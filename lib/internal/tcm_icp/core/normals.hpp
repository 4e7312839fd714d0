#pragma once
// Surface normals and point spacing of a cloud.

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

struct NormalOptions {
  int min_neighbors = 12;  ///< >= 3; the smallest neighbourhood that is tried
  int max_neighbors = 48;  ///< the largest: neighbourhoods that form a line (one scan ring) are doubled up to it
  void validate() const;   ///< throws InvalidOptions
};

struct NormalEstimate {
  Points normals;                 ///< unit vectors of arbitrary sign; zero where no surface could be told
  std::vector<double> variation;  ///< surface variation: least eigenvalue by their sum, 0 (plane) to 1/3 (no direction)
  std::vector<double> roughness_m;  ///< [m] standard deviation of the neighbours from their plane
};

/// Normals by principal components of each point's nearest neighbours. A neighbourhood on a line has no normal, so it
/// is doubled until its second axis is at least a fifth as long as its first, or max_neighbors is reached. Cost O(N k
/// log N) on `num_threads` threads; the result does not depend on their number.
NormalEstimate estimate_normals(const Points& points, const NeighborIndex& index, const NormalOptions& options,
                                int num_threads);

/// The same of the points nearest to each of `queries`. Cost O(Q k log N).
NormalEstimate estimate_normals_at(const Points& queries, const Points& points, const NeighborIndex& index,
                                   const NormalOptions& options, int num_threads);

/// Median distance [m] from a point to its nearest other point, over at most 2,000 points spread evenly; 0 where fewer
/// than two points.
double median_spacing(const Points& points, const NeighborIndex& index);

}  // namespace tcm_icp
