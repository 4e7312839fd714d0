#pragma once
// Matches by place: neighbours share their errors, so it is blocks of them that are independent, not points.

#include <cstddef>
#include <utility>
#include <vector>

#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// Position of a match in a vector of links.
struct MatchId {
  std::size_t link = 0, match = 0;
};

/// The matches of all links in one cube of edge `edge_m` make a block, whatever scans they are of, because a surface
/// that misleads one pair of scans misleads others. In the order of the cubes; within one, in the matches' order.
/// O(N), and sorting the cubes.
std::vector<std::vector<MatchId>> blocks_of(const std::vector<JointLink>& links, double edge_m);

}  // namespace tcm_icp
