#include "inference/minimum_cuts.hpp"

#include <algorithm>
#include <limits>

namespace tcm_icp {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr double kLeastLeft = 1e-9;  // less is rounding

// Maximum flows between nodes, along shortest paths (Edmonds and Karp, 1972).
class Flows {
 public:
  Flows(const std::vector<WeightedEdge>& edges, std::size_t num_nodes)
      : edges_(edges), of_node_(num_nodes), flow_(edges.size()), way_(num_nodes, kNone) {
    for (std::size_t k = 0; k < edges.size(); ++k) {
      of_node_[edges[k].a].push_back(k);
      of_node_[edges[k].b].push_back(k);
    }
  }

  double weight_of(std::size_t node) const {
    double sum = 0;
    for (const std::size_t k : of_node_[node]) sum += edges_[k].weight;
    return sum;
  }

  /// Whether each node is on the side of `from` in a minimum cut between the two: the smallest such side.
  std::vector<bool> side_of(std::size_t from, std::size_t to) {
    std::fill(flow_.begin(), flow_.end(), 0);
    while (find_ways(from, to)) {
      double least = std::numeric_limits<double>::infinity();
      for_each_edge_to(to, from, [&](std::size_t k, std::size_t i) { least = std::min(least, left(k, i)); });
      for_each_edge_to(to, from, [&](std::size_t k, std::size_t i) { flow_[k] += i == edges_[k].a ? least : -least; });
    }
    std::vector<bool> side(of_node_.size(), false);
    for (const std::size_t i : reached_) side[i] = true;
    return side;
  }

 private:
  // What edge k still takes on from node i.
  double left(std::size_t k, std::size_t i) const {
    return edges_[k].weight - (i == edges_[k].a ? flow_[k] : -flow_[k]);
  }
  std::size_t other_end(std::size_t k, std::size_t i) const { return edges_[k].a == i ? edges_[k].b : edges_[k].a; }

  // The edge by which each node is reached first, until `to` is: false where it is not.
  bool find_ways(std::size_t from, std::size_t to) {
    for (const std::size_t i : reached_) way_[i] = kNone;
    reached_.assign(1, from);
    for (std::size_t next = 0; next < reached_.size(); ++next) {
      const std::size_t i = reached_[next];
      for (const std::size_t k : of_node_[i]) {
        const std::size_t j = other_end(k, i);
        if (j == from || way_[j] != kNone || left(k, i) <= kLeastLeft) continue;
        way_[j] = k;
        reached_.push_back(j);
        if (j == to) return true;
      }
    }
    return false;
  }

  // Backwards from `to`: each edge with the node it is entered from.
  template <typename Visit>
  void for_each_edge_to(std::size_t to, std::size_t from, Visit visit) const {
    for (std::size_t j = to; j != from;) {
      const std::size_t k = way_[j], i = other_end(k, j);
      visit(k, i);
      j = i;
    }
  }

  const std::vector<WeightedEdge>& edges_;
  std::vector<std::vector<std::size_t>> of_node_;
  std::vector<double> flow_;  // of each edge, from a to b
  std::vector<std::size_t> way_;
  std::vector<std::size_t> reached_;  // in the order of their distance
};

// Classes of nodes that no cut parts yet.
class Classes {
 public:
  Classes(const std::vector<WeightedEdge>& edges, const std::vector<std::size_t>& nodes, std::size_t root)
      : nodes_(nodes), root_(root), flows_(edges, nodes.back() + 1), class_of_(nodes.back() + 1, 0), members_{nodes} {}

  bool has_both(std::size_t a, std::size_t b) const { return class_of_[a] == class_of_[b]; }

  void split(std::size_t a, std::size_t b) {
    // From the one that is held by less: as a rule it is parted by itself. Of cuts that weigh the same, one near it.
    const bool a_first = b == root_ || (a != root_ && flows_.weight_of(a) <= flows_.weight_of(b));
    const std::vector<bool> side = a_first ? flows_.side_of(a, b) : flows_.side_of(b, a);
    std::vector<std::size_t>& old = members_[class_of_[a]];
    const auto begin = std::stable_partition(old.begin(), old.end(), [&](std::size_t i) { return !side[i]; });
    std::vector<std::size_t> parted(begin, old.end());
    old.erase(begin, old.end());
    for (const std::size_t i : parted) class_of_[i] = members_.size();
    members_.push_back(std::move(parted));
    std::vector<std::size_t>& cut = cuts_.emplace_back();
    for (const std::size_t i : nodes_) {
      if (side[i] != side[root_]) cut.push_back(i);
    }
  }

  void split_all() {
    for (std::size_t k = 0; k < members_.size(); ++k) {
      while (members_[k].size() > 1) split(members_[k][0], members_[k][1]);
    }
  }

  std::vector<std::vector<std::size_t>> take_cuts() { return std::move(cuts_); }

 private:
  const std::vector<std::size_t>& nodes_;
  std::size_t root_;
  Flows flows_;
  std::vector<std::size_t> class_of_;
  std::vector<std::vector<std::size_t>> members_, cuts_;
};

}  // namespace

std::vector<std::vector<std::size_t>> minimum_cuts(const std::vector<WeightedEdge>& edges,
                                                   const std::vector<std::size_t>& nodes, std::size_t root) {
  Classes classes(edges, nodes, root);
  for (const WeightedEdge& edge : edges) {
    if (classes.has_both(edge.a, edge.b)) classes.split(edge.a, edge.b);
  }
  classes.split_all();
  return classes.take_cuts();
}

}  // namespace tcm_icp
