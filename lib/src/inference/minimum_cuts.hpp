#pragma once
// What holds the nodes of a weighted graph together at the least.

#include <cstddef>
#include <vector>

namespace tcm_icp {

struct WeightedEdge {
  double weight = 0;  ///< > 0
  std::size_t a = 0, b = 0;
};

/// Cuts, one less than there are nodes, each as the nodes on its side without `root`: of any two nodes a minimum cut is
/// among them, but for ties. Classes of nodes are split by the minimum cut between two of them until each node is alone
/// (Gomory and Hu, 1961; without contraction, Gusfield, 1990). Neighbours part first: flows between them stay near, so
/// that a large graph of bounded degree costs little more than its nodes.
/// @param nodes  ascending; edges are between them
std::vector<std::vector<std::size_t>> minimum_cuts(const std::vector<WeightedEdge>& edges,
                                                   const std::vector<std::size_t>& nodes, std::size_t root);

}  // namespace tcm_icp
