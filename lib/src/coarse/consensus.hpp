#pragma once
// Poses that many matches agree on.

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "compatibility_graph.hpp"

namespace tcm_icp {

struct ConsensusOptions {
  float tolerance = 0;            ///< [voxels] > 0; of a length, and of a match under a pose
  float min_length = 0;           ///< [voxels] of an edge of the graph
  float normal_tolerance = 0.2F;  ///< of the cosine between two normals
  std::size_t max_poses = 16;
  std::size_t max_members = 30;  ///< matches of a seed's first fit
};

struct ConsensusPose {
  Eigen::Isometry3f T_target_source = Eigen::Isometry3f::Identity();  ///< [voxels]
  float votes = 0;  ///< matches that hold, each counted by how well it does
};

/// The votes for one pose.
float count_votes(const MatchedPoints& matches, const Eigen::Isometry3f& T_target_source,
                  const ConsensusOptions& options);

/// Seeds are taken by the number of triangles they form in the compatibility graph; each seed's best neighbours give a
/// pose, which is fitted to all matches that hold under it; these seed no other pose. By votes, most first.
std::vector<ConsensusPose> find_consensus(const MatchedPoints& matches, const ConsensusOptions& options);

}  // namespace tcm_icp
