#pragma once
// Parts of a component that lie on one another though they are but alike.

#include <cstddef>
#include <vector>

#include "inference/less_likely_across.hpp"
#include "inference/seen_through.hpp"

namespace tcm_icp {

/// By what they see through of one another, and by how likely pairs between them are.
class AlikeParts {
 public:
  /// By the pairs of the component that were measured at these very poses. Cost: see SeenThrough.
  AlikeParts(const PairGraph& graph, const Component& component);

  /// By how much less the agreement of two scans says against twins: up to log_alike.
  double less_said(std::size_t a, std::size_t b) const;

  /// Those that may be twins of others, ascending, or all that is not of one where it has the reference. Some may be
  /// named twice.
  std::vector<std::vector<std::size_t>> parts() const;

 private:
  SeenThrough seen_through_;
  LessLikelyAcross less_likely_;
  double log_alike_;
};

}  // namespace tcm_icp
