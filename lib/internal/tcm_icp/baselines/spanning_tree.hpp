#pragma once
// How a conventional method puts a whole set together: each scan by its best pairs.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "tcm_icp/baselines/pair_fit.hpp"

namespace tcm_icp {

/// Positions of the pairs in the maximum spanning forest by share (Kruskal); of equal shares the pair of the least mean
/// distance, then the earlier one. In the order they were taken. O(P log P).
std::vector<std::size_t> maximum_spanning_tree(std::size_t num_scans, const std::vector<PairFit>& pairs);

/// The scan of most pairs in the tree; among equals the one nearest the middle of the file list.
/// @throws InvalidInput  if there is no scan
std::size_t tree_reference(std::size_t num_scans, const std::vector<PairFit>& pairs,
                           const std::vector<std::size_t>& tree);

/// T_reference_scan of each scan along the tree's pairs; nothing where none lead to the reference.
std::vector<std::optional<Eigen::Isometry3d>> poses_along_tree(std::size_t num_scans, const std::vector<PairFit>& pairs,
                                                               const std::vector<std::size_t>& tree,
                                                               std::size_t reference);

}  // namespace tcm_icp
