#pragma once
// Where a scan may lie beside the members of a component, by the hypotheses of its pairs with them.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "inference/compared_pairs.hpp"

namespace tcm_icp {

/// A pose of a scan, and what the members say for it (PairGraph::support_of).
struct Place {
  double support = 0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
};

/// Keeps a reference to the graph, which must outlive it.
class Places {
 public:
  Places(const PairGraph& graph, std::size_t scan) : graph_(&graph), scan_(scan) {}

  /// The poses that hypotheses of all members lead to.
  static Places beside(const PairGraph& graph, std::size_t scan, const Component& component);

  /// A member more: what its pair with the scan says of the poses so far, and those it leads to. Members must not have
  /// moved since the others were added.
  void add(const ComparedPair& pair, const Component& component);

  /// The best supported of the poses, and of what agrees with one on average; none where there is none.
  std::optional<Place> best(const Component& component) const;

 private:
  const PairGraph* graph_;
  std::size_t scan_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<double> supports_;  ///< of the poses
};

}  // namespace tcm_icp
