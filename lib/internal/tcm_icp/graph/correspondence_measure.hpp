#pragma once
// correspondence(P_i, P_j): how close two clouds are, smaller is closer. The paper leaves it open;
// docs/decisions/0004-correspondence.md.

#include <Eigen/Geometry>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

/// A cloud with its index; refers to both, owns neither. Clouds of more than 2,000 points are looked up by an even
/// sample of 2,000, so a measure costs O(log N) per pair, not O(N).
struct IndexedPoints {
  const Points& points;
  const NeighborIndex& index;  ///< of the same points
};

/// The paper's correspondence(): mean of the two directions' mean nearest-neighbour distance [m], clouds in one frame.
/// Symmetric. @throws InvalidInput  if a cloud is empty
double correspondence_distance(const IndexedPoints& a, const IndexedPoints& b);

/// Share 0..1 of a's points, or of an even sample as above, with a neighbour in b within `radius_m`, with b moved by
/// T_a_b.
/// @throws InvalidInput  if a cloud is empty or the radius is not positive
double overlap_share(const PyramidLevel& a, const PyramidLevel& b, const Eigen::Isometry3d& T_a_b, double radius_m);

/// Overlap of a pair 0..1: the larger of the two directions, so that a small scan wholly inside a large one overlaps
/// fully, whatever the large one covers besides. The robust correspondence is 1 - overlap.
double overlap(const PyramidLevel& a, const PyramidLevel& b, const Eigen::Isometry3d& T_a_b, double radius_m);

}  // namespace tcm_icp
