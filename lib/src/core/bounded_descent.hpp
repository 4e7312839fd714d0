#pragma once
// One walk down a kd-tree for every kind of query: nearer child first, subtrees beyond the limit left out.

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "core/flat_tree.hpp"

namespace tcm_icp {

/// Shows `visitor` every point of the tree that may lie within its limit. CGAL's own searches allocate a queue a query
/// and cannot start from a radius; this one does neither.
///
/// Exact and independent of the tree's shape: a box's bound sums the squares of its three gaps in the order in which a
/// point's distance is summed, and rounding is monotone, so a bound never exceeds the distance of a point in the box,
/// and points at exactly the limit are shown, too.
///
/// @tparam Visitor  double limit_m2() const, which may fall but not rise; void take(key, squared_distance_m2)
template <typename Visitor>
class BoundedDescent {
 public:
  /// @param tree   not empty
  /// @param query  finite
  BoundedDescent(const FlatTree& tree, const Eigen::Vector3d& query, Visitor& visitor)
      : tree_(tree), query_{query.x(), query.y(), query.z()}, visitor_(visitor) {}

  void run() {
    for (int axis = 0; axis < 3; ++axis) {
      squared_gaps_[axis] = squared_gap(axis, tree_.bounds(axis)[0], tree_.bounds(axis)[1]);
    }
    if (bound() <= visitor_.limit_m2()) visit(0);
  }

 private:
  double squared_gap(int axis, double low, double high) const {
    const double gap = std::max(std::max(low - query_[axis], query_[axis] - high), 0.0);
    return gap * gap;
  }
  double bound() const { return squared_gaps_[0] + squared_gaps_[1] + squared_gaps_[2]; }

  void visit(std::uint32_t place) {
    const FlatTree::Node& node = tree_.node(place);
    if (node.is_leaf()) {
      visit_leaf(node);
      return;
    }
    const int axis = static_cast<int>(node.axis_or_size);
    const double lower = squared_gap(axis, node.lower_low, node.lower_high);
    const double upper = squared_gap(axis, node.upper_low, node.upper_high);
    const double outer = squared_gaps_[axis];
    if (lower < upper) {
      visit_child(place + 1, axis, lower);
      visit_child(node.upper_or_begin, axis, upper);
    } else {
      visit_child(node.upper_or_begin, axis, upper);
      visit_child(place + 1, axis, lower);
    }
    squared_gaps_[axis] = outer;
  }

  void visit_child(std::uint32_t child, int axis, double squared_gap_m2) {
    squared_gaps_[axis] = squared_gap_m2;
    if (bound() <= visitor_.limit_m2()) visit(child);
  }

  void visit_leaf(const FlatTree::Node& leaf) {
    const double* coordinate = tree_.coordinates(leaf.upper_or_begin);
    for (std::uint32_t i = 0; i < leaf.size(); ++i, coordinate += 3) {
      const double x = query_[0] - coordinate[0], y = query_[1] - coordinate[1], z = query_[2] - coordinate[2];
      const double squared_m2 = x * x + y * y + z * z;
      if (squared_m2 <= visitor_.limit_m2()) visitor_.take(tree_.key(leaf.upper_or_begin + i), squared_m2);
    }
  }

  const FlatTree& tree_;
  const std::array<double, 3> query_;
  std::array<double, 3> squared_gaps_{};  ///< [m^2] from the query to the current box, one an axis
  Visitor& visitor_;
};

}  // namespace tcm_icp
