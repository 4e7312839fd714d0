#pragma once
// A kd-tree in three arrays, as CGAL's built it: less memory than its nodes take, and what can be put away as a whole.

#include <CGAL/Kd_tree.h>

#include <array>
#include <cstdint>
#include <vector>

#include "tcm_icp/core/paged_allocator.hpp"

namespace tcm_icp {

/// Nodes in the order of a walk that goes to the lower child first, so that it is the next node; points in the order of
/// the leaves.
class FlatTree {
 public:
  /// Of a leaf its points, of another node how its children lie along the axis it is cut across.
  struct Node {
    double lower_low = 0, lower_high = 0, upper_low = 0, upper_high = 0;
    std::uint32_t upper_or_begin = 0;  ///< the upper child; of a leaf its first point
    std::uint32_t axis_or_size = 0;    ///< 0 to 2; of a leaf kLeaf and the number of its points
    bool is_leaf() const { return axis_or_size >= kLeaf; }
    std::uint32_t size() const { return axis_or_size - kLeaf; }
  };
  static constexpr std::uint32_t kLeaf = 4;

  FlatTree() = default;

  /// @tparam Tree  CGAL::Kd_tree of 3-D points with extended nodes and cached coordinates, built and not empty
  template <typename Tree>
  explicit FlatTree(const Tree& tree) : keys_(tree.begin(), tree.end()) {
    const auto& box = tree.bounding_box();
    for (int axis = 0; axis < 3; ++axis) bounds_[axis] = {box.min_coord(axis), box.max_coord(axis)};
    coordinates_.assign(tree.cache_begin(), tree.cache_begin() + static_cast<std::ptrdiff_t>(3 * keys_.size()));
    add(tree, tree.root());
    nodes_.shrink_to_fit();
  }

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  std::uint32_t key(std::uint32_t point) const { return keys_[point]; }
  const double* coordinates(std::uint32_t point) const { return coordinates_.data() + 3 * std::size_t{point}; }
  /// Least and greatest coordinate along an axis.
  const std::array<double, 2>& bounds(int axis) const { return bounds_[axis]; }

 private:
  template <typename Tree>
  void add(const Tree& tree, typename Tree::Node_const_handle node) {
    const std::size_t place = nodes_.size();
    nodes_.emplace_back();
    if (node->is_leaf()) {
      const auto leaf = static_cast<typename Tree::Leaf_node_const_handle>(node);
      nodes_[place].upper_or_begin = static_cast<std::uint32_t>(leaf->begin() - tree.begin());
      nodes_[place].axis_or_size = kLeaf + static_cast<std::uint32_t>(leaf->end() - leaf->begin());
      return;
    }
    const auto cut = static_cast<typename Tree::Internal_node_const_handle>(node);
    nodes_[place] = {cut->lower_low_value(),
                     cut->lower_high_value(),
                     cut->upper_low_value(),
                     cut->upper_high_value(),
                     0,
                     static_cast<std::uint32_t>(cut->cutting_dimension())};
    add(tree, cut->lower());
    nodes_[place].upper_or_begin = static_cast<std::uint32_t>(nodes_.size());
    add(tree, cut->upper());
  }

  std::vector<Node, PagedAllocator<Node>> nodes_;
  std::vector<std::uint32_t, PagedAllocator<std::uint32_t>> keys_;
  std::vector<double, PagedAllocator<double>> coordinates_;
  std::array<std::array<double, 2>, 3> bounds_{};
};

}  // namespace tcm_icp
