#pragma once
// One walk down a CGAL kd-tree for every kind of query: nearer child first, subtrees beyond the limit left out.

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace tcm_icp {

/// Shows `visitor` every point of the tree that may lie within its limit. CGAL's own searches allocate a queue a query
/// and cannot start from a radius; this one does neither.
///
/// Exact and independent of the tree's shape: a box's bound sums the squares of its three gaps in the order in which a
/// point's distance is summed, and rounding is monotone, so a bound never exceeds the distance of a point in the box,
/// and points at exactly the limit are shown, too.
///
/// @tparam Tree     CGAL::Kd_tree of 3-D points with extended nodes and cached coordinates
/// @tparam Visitor  double limit_m2() const, which may fall but not rise; void take(key, squared_distance_m2)
template <typename Tree, typename Visitor>
class BoundedDescent {
 public:
  /// @param query  finite
  BoundedDescent(const Tree& tree, const Eigen::Vector3d& query, Visitor& visitor)
      : tree_(tree), query_{query.x(), query.y(), query.z()}, visitor_(visitor) {}

  void run() {
    const auto& box = tree_.bounding_box();
    for (int axis = 0; axis < 3; ++axis) {
      squared_gaps_[axis] = squared_gap(axis, box.min_coord(axis), box.max_coord(axis));
    }
    if (bound() <= visitor_.limit_m2()) visit(tree_.root());
  }

 private:
  using Node = typename Tree::Node_const_handle;
  using Leaf = typename Tree::Leaf_node_const_handle;
  using Internal = typename Tree::Internal_node_const_handle;

  double squared_gap(int axis, double low, double high) const {
    const double gap = std::max(std::max(low - query_[axis], query_[axis] - high), 0.0);
    return gap * gap;
  }
  double bound() const { return squared_gaps_[0] + squared_gaps_[1] + squared_gaps_[2]; }

  void visit(Node node) {
    if (node->is_leaf()) {
      visit_leaf(static_cast<Leaf>(node));
      return;
    }
    const auto internal = static_cast<Internal>(node);
    const int axis = internal->cutting_dimension();
    const double lower = squared_gap(axis, internal->lower_low_value(), internal->lower_high_value());
    const double upper = squared_gap(axis, internal->upper_low_value(), internal->upper_high_value());
    const double outer = squared_gaps_[axis];
    if (lower < upper) {
      visit_child(internal->lower(), axis, lower);
      visit_child(internal->upper(), axis, upper);
    } else {
      visit_child(internal->upper(), axis, upper);
      visit_child(internal->lower(), axis, lower);
    }
    squared_gaps_[axis] = outer;
  }

  void visit_child(Node child, int axis, double squared_gap_m2) {
    squared_gaps_[axis] = squared_gap_m2;
    if (bound() <= visitor_.limit_m2()) visit(child);
  }

  void visit_leaf(Leaf leaf) {
    auto coordinate = tree_.cache_begin() + 3 * (leaf->begin() - tree_.begin());
    for (auto key = leaf->begin(); key != leaf->end(); ++key, coordinate += 3) {
      const double x = query_[0] - coordinate[0], y = query_[1] - coordinate[1], z = query_[2] - coordinate[2];
      const double squared_m2 = x * x + y * y + z * z;
      if (squared_m2 <= visitor_.limit_m2()) visitor_.take(*key, squared_m2);
    }
  }

  const Tree& tree_;
  const std::array<double, 3> query_;
  std::array<double, 3> squared_gaps_{};  ///< [m^2] from the query to the current box, one an axis
  Visitor& visitor_;
};

}  // namespace tcm_icp
