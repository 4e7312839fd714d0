#pragma once
// Parts of a component between which pairs are less likely than within: places that are alike, but not the same.

#include <cstddef>
#include <vector>

#include "inference/compared_pairs.hpp"
#include "inference/joined_parts.hpp"

namespace tcm_icp {

/// The scans of a component in parts, within each of which pairs show about as much for their poses as is usual of the
/// set. Each pair at a twin may say a little for it, since it agrees there as it would where two scans see little of
/// one another, and a storey's worth of pairs all say so together; but all of them say less than the pairs of each
/// storey do, though they overlap as much. Joined one after another, those first that show most, as long as what pairs
/// between two show is usual.
class LessLikelyAcross {
 public:
  /// By the pairs of the component that were measured at these very poses.
  /// Cost: the pairs that were measured anywhere, and for each member the parts about it.
  LessLikelyAcross(const PairGraph& graph, const Component& component);

  /// Of the parts of two scans: how much less the log-odds of pairs between them are than within, for their overlap and
  /// on average, less a standard error; 0 within a part, and where pairs between them overlap less than is usual: twins
  /// lie on one another.
  double deficit(std::size_t a, std::size_t b) const;

  /// How surely two scans are of parts that are twins: 1 from kTwinDeficit on, 0 up to kUsualDeficit.
  double twins(std::size_t a, std::size_t b) const;

  /// Of the parts with which pairs of others are less likely than usual each, or all that is not of it where it has the
  /// reference; ascending. Some may be named twice.
  std::vector<std::vector<std::size_t>> parts() const;

 private:
  // Log-odds of pairs, beyond what is usual for their overlap, by their weights.
  struct Shown {
    double pairs = 0, weight = 0, sum = 0;
    Shown& operator+=(const Shown& other);
  };

  double deficit_of_parts(std::size_t part, std::size_t other) const;

  const Component& component_;
  JoinedParts<Shown> parts_;
  double usual_ = 0, usual_weight_ = 0;  // of pairs that are of one part
};

}  // namespace tcm_icp
