#pragma once
// First centroids for k-means, well apart from each other (paper, section III.A).

#include <cstddef>
#include <span>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

struct KMeansSeeds {
  Points centroids;             ///< points of the cloud, pairwise farther apart than the radius
  std::size_t num_covered = 0;  ///< points of the cloud within the radius of a centroid
};

/// The first point of `order` becomes a centroid and all points within `radius_m` of it are taken away; repeated among
/// the rest until there are `max_centroids`, or no point is left.
/// @param index  of `points`
/// @param order  indices of the points in random order: draw_order()
/// @throws InvalidOptions  if the radius is not positive or max_centroids is 0
/// Cost: one sphere query a centroid.
KMeansSeeds seed_kmeans(const Points& points, const NeighborIndex& index, double radius_m, std::size_t max_centroids,
                        std::span<const std::size_t> order);

/// The radius [m] with which about `num_clusters` spheres tile the surface: the smallest of a geometric series (steps
/// of 2^(1/4), down from the extent) with which half as many spheres cover half the points. The other half does not
/// count, for stray points need a sphere each and would set the radius; also with a quarter of strays it grows by a
/// half at most. Found on the first 4,096 points of `order`; scales and turns with the cloud.
/// @throws InvalidInput  if all points are equal, or there are none
double seeding_radius(const Points& points, std::size_t num_clusters, std::span<const std::size_t> order);

}  // namespace tcm_icp
