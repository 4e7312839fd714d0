#include "inference/minimum_cuts.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace tcm_icp {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr double kLeastLeft = 1e-9;  // less is rounding

// Maximum flows between nodes, along shortest paths (Edmonds and Karp, 1972) that are looked for from both ends: where
// one end is held by little, its few neighbours tell that no more gets through, not the whole graph about the other.
class Flows {
 public:
  Flows(const std::vector<WeightedEdge>& edges, std::size_t num_nodes)
      : edges_(edges), of_node_(num_nodes), flow_(edges.size()), trees_{Tree(num_nodes), Tree(num_nodes)} {
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
    while (find_path(from, to)) {
      double least = std::numeric_limits<double>::infinity();
      for (const Step& s : path_) least = std::min(least, left(s.edge, s.from));
      for (const Step& s : path_) flow_[s.edge] += s.from == edges_[s.edge].a ? least : -least;
    }
    while (trees_[kForward].has_next()) grow(kForward);
    std::vector<bool> side(of_node_.size(), false);
    for (const std::size_t i : trees_[kForward].reached) side[i] = true;
    return side;
  }

 private:
  enum Direction : std::size_t { kForward, kBackward };

  struct Step {
    std::size_t edge, from;
  };

  // Of shortest ways from one of the two ends.
  struct Tree {
    explicit Tree(std::size_t num_nodes) : way(num_nodes, kNone) {}

    void begin(std::size_t root) {
      for (const std::size_t i : reached) way[i] = kNone;
      reached.assign(1, root);
      next = 0;
    }
    bool has_next() const { return next < reached.size(); }
    bool has(std::size_t i) const { return i == reached.front() || way[i] != kNone; }
    std::size_t num_open() const { return reached.size() - next; }

    std::vector<std::size_t> way;      // the edge by which each node is reached
    std::vector<std::size_t> reached;  // in the order of their distance
    std::size_t next = 0;              // of them the first whose edges were not looked at
  };

  // What edge k still takes on from node i.
  double left(std::size_t k, std::size_t i) const {
    return edges_[k].weight - (i == edges_[k].a ? flow_[k] : -flow_[k]);
  }
  std::size_t other_end(std::size_t k, std::size_t i) const { return edges_[k].a == i ? edges_[k].b : edges_[k].a; }

  // A path that takes more on, into path_: false where there is none, and one tree holds all that its end reaches.
  bool find_path(std::size_t from, std::size_t to) {
    trees_[kForward].begin(from);
    trees_[kBackward].begin(to);
    while (trees_[kForward].has_next() && trees_[kBackward].has_next()) {
      const bool forward = trees_[kForward].num_open() <= trees_[kBackward].num_open();
      if (grow(forward ? kForward : kBackward)) return true;
    }
    return false;
  }

  // By the nodes that are one edge farther; true, with path_, once one of them is in the other tree.
  bool grow(Direction direction) {
    Tree &tree = trees_[direction], &other = trees_[1 - direction];
    for (const std::size_t end = tree.reached.size(); tree.next < end; ++tree.next) {
      const std::size_t i = tree.reached[tree.next];
      for (const std::size_t k : of_node_[i]) {
        const std::size_t j = other_end(k, i);
        if (tree.has(j) || left(k, direction == kForward ? i : j) <= kLeastLeft) continue;
        tree.way[j] = k;
        tree.reached.push_back(j);
        if (!other.has(j)) continue;
        path_.clear();
        add_way(kForward, j);
        add_way(kBackward, j);
        return true;
      }
    }
    return false;
  }

  // From node i to the root of a tree: each edge with the node it is entered from by what flows.
  void add_way(Direction direction, std::size_t i) {
    const Tree& tree = trees_[direction];
    while (i != tree.reached.front()) {
      const std::size_t k = tree.way[i], nearer = other_end(k, i);
      path_.push_back({k, direction == kForward ? nearer : i});
      i = nearer;
    }
  }

  const std::vector<WeightedEdge>& edges_;
  std::vector<std::vector<std::size_t>> of_node_;
  std::vector<double> flow_;  // of each edge, from a to b
  std::array<Tree, 2> trees_;
  std::vector<Step> path_;
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
