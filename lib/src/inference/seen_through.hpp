#pragma once
// Parts of a component that see through one another more than they see through their own: storeys that are alike.

#include <cstddef>
#include <vector>

#include "inference/compared_pairs.hpp"
#include "inference/joined_parts.hpp"

namespace tcm_icp {

/// Up to where right parts have it, too, because one half of a set differs from the other, and from where on hardly any
/// have (docs/decisions/0013).
constexpr double kUsualExcess = 0.6, kTwinExcess = 1;

/// Storeys that look alike agree where they are laid on one another, but each sees through what stands only in the
/// other. People about a scanner are seen through, too, by all that overlap with it much, and see through nobody: so
/// either part must see through the other, and what overlaps little tells little. Scans and parts are joined one after
/// another, those first that are likeliest to see through one another no more than is usual, as long as the excess
/// between two parts is usual.
class SeenThrough {
 public:
  /// By the pairs of the component that were measured at these very poses.
  /// Cost: the pairs that were measured anywhere, and for each member the parts about it.
  SeenThrough(const PairGraph& graph, const Component& component);

  /// Of the parts of two scans: logarithm of how many times as much of the one the other sees through as it does
  /// itself, less a standard error, or the other way round, whichever is less; shares that right poses have are one. 0
  /// within a part, and where of either too few points were looked at.
  double excess(std::size_t a, std::size_t b) const;

  /// How surely two scans are of parts that are twins: 1 from kTwinExcess on, 0 up to kUsualExcess.
  double twins(std::size_t a, std::size_t b) const;

  /// Of the parts that others see through more than is usual each, or all that is not of it where it has the reference;
  /// ascending. Some may be named twice.
  std::vector<std::vector<std::size_t>> parts() const;

 private:
  // Points of a part, looked at by its own scans or another's; of pairs that overlap little fewer.
  struct Looked {
    double pairs = 0, points = 0, violations = 0, large = 0;
    Looked& operator+=(const Looked& other);
  };

  static double share(const Looked& looked);
  // Between parts: what may stand between two rays makes no twins.
  static double share_between(const Looked& looked);
  static Looked looked_at(const LookedAt& points, double overlap);
  double excess_of_parts(std::size_t part, std::size_t other) const;
  // Of what is seen of `part` from `other`.
  double excess_one_way(std::size_t part, std::size_t other) const;
  bool tells_within(std::size_t part) const;
  // How much likelier it is to see through as much as is usual than through a few times as much.
  double promise(const Looked& between) const;

  const Component& component_;
  JoinedParts<Looked> parts_;
  Looked usual_;  // stands for two parts of which neither has pairs of its own
};

}  // namespace tcm_icp
