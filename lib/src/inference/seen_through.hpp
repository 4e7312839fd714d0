#pragma once
// What a part of a component and the rest of it see through one another, by what either sees through of its own.

#include <cstddef>
#include <vector>

#include "inference/compared_pairs.hpp"

namespace tcm_icp {

/// Up to where right cuts have it, too, because one part of a set differs from the other (19 in 20 between parts of
/// several scans), and from where on hardly any has (docs/decisions/0013).
constexpr double kUsualExcess = 0.5, kTwinExcess = 1;

/// Storeys that look alike agree where they are laid on one another, but each sees through what stands only in the
/// other. So do scans with people about, but all their pairs alike, within a part and across.
class SeenThrough {
 public:
  /// Pairs of the component that were measured at these very poses. Cost: the pairs that were measured anywhere.
  SeenThrough(const PairGraph& graph, const Component& component);

  /// Logarithm of how many times as much is seen through across a cut as within the side that sees through less, less a
  /// standard error; at least 0. Shares that right poses have are one. 0 unless both sides have looked at enough of
  /// their own: a scan by itself may as well have people about it. Cost: the pairs.
  /// @param moved  of every scan, whether it is of the part
  double excess(const std::vector<bool>& moved) const;

  /// Parts, ascending and without the reference, across whose cut the excess is `least` or more, of those that come
  /// about where scans and parts are joined one after another, the ones first that are likeliest to see through one
  /// another no more than is usual. Some may be named twice. Cost: members times pairs.
  std::vector<std::vector<std::size_t>> parts(double least) const;

 private:
  struct Pair {
    std::size_t a, b;
    double points, violations;
  };

  const Component& component_;
  std::vector<Pair> pairs_;
};

}  // namespace tcm_icp
