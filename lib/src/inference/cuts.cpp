#include "inference/cuts.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace tcm_icp {
namespace {

struct Edge {
  double support;
  std::size_t a, b;
};

// Edges of a maximum spanning tree (Kruskal); forests where members do not hold together.
std::vector<Edge> spanning_tree(const PairGraph& graph, const Component& component) {
  std::vector<Edge> edges, tree;
  for (const ComparedPair& pair : graph.pairs()) {
    if (!component.has(pair.a) || !component.has(pair.b)) continue;
    const double support =
        graph.support(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]);
    if (support > 0) edges.push_back({support, pair.a, pair.b});
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) { return x.support > y.support; });
  std::vector<std::size_t> root(graph.num_scans());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const Edge& edge : edges) {
    const std::size_t a = find(edge.a), b = find(edge.b);
    if (a == b) continue;
    root[a] = b;
    tree.push_back(edge);
  }
  return tree;
}

// The scans on the far side of an edge, as seen from the reference.
std::vector<std::size_t> beyond(const std::vector<Edge>& tree, std::size_t removed, std::size_t reference,
                                const Component& component) {
  std::vector<std::vector<std::size_t>> neighbors(component.T_reference_scan.size());
  for (std::size_t k = 0; k < tree.size(); ++k) {
    if (k == removed) continue;
    neighbors[tree[k].a].push_back(tree[k].b);
    neighbors[tree[k].b].push_back(tree[k].a);
  }
  std::vector<bool> reached(neighbors.size(), false);
  std::vector<std::size_t> open{reference};
  reached[reference] = true;
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for (const std::size_t j : neighbors[i]) {
      if (reached[j]) continue;
      reached[j] = true;
      open.push_back(j);
    }
  }
  std::vector<std::size_t> out;
  for (const std::size_t i : component.members()) {
    if (!reached[i]) out.push_back(i);
  }
  return out;
}

}  // namespace

Cut measure_cut(const PairGraph& graph, const Component& component, std::vector<std::size_t> moved) {
  Cut cut{std::move(moved), -graph.options().log_poses, 0, std::nullopt};
  std::vector<bool> is_moved(graph.num_scans(), false);
  for (const std::size_t i : cut.moved) is_moved[i] = true;
  std::vector<const ComparedPair*> across;
  std::set<std::size_t> seen;
  for (const std::size_t i : cut.moved) {
    for (const std::size_t k : graph.pairs_of(i)) {
      const ComparedPair& pair = graph.pairs()[k];
      const bool crosses = component.has(pair.a) && component.has(pair.b) && is_moved[pair.a] != is_moved[pair.b];
      if (crosses && seen.insert(k).second) across.push_back(&pair);
    }
  }
  const auto pose = [&](std::size_t i, const Eigen::Isometry3d& motion) -> Eigen::Isometry3d {
    return is_moved[i] ? motion * *component.T_reference_scan[i] : *component.T_reference_scan[i];
  };
  const auto support = [&](const Eigen::Isometry3d& motion) {
    double sum = -graph.options().log_poses;
    for (const ComparedPair* pair : across) sum += graph.support(*pair, pose(pair->a, motion), pose(pair->b, motion));
    return sum;
  };
  cut.support = support(Eigen::Isometry3d::Identity());
  std::vector<Eigen::Isometry3d> known{Eigen::Isometry3d::Identity()};
  for (const ComparedPair* pair : across) {
    const std::size_t scan = is_moved[pair->b] ? pair->b : pair->a, fixed = scan == pair->b ? pair->a : pair->b;
    const Eigen::Isometry3d &T_scan = *component.T_reference_scan[scan], &T_fixed = *component.T_reference_scan[fixed];
    for (const PoseHypothesis& h : pair->hypotheses) {
      const Eigen::Isometry3d T_fixed_scan = scan == pair->b ? h.T_a_b : h.T_a_b.inverse();
      const Eigen::Isometry3d motion = T_fixed * T_fixed_scan * T_scan.inverse();
      const bool is_known = std::any_of(known.begin(), known.end(), [&](const Eigen::Isometry3d& m) {
        return graph.same_pose(scan, m * T_scan, motion * T_scan);
      });
      if (is_known) continue;
      known.push_back(motion);
      const double other = support(motion);
      if (cut.other_motion && other <= cut.other_support) continue;
      cut.other_support = other;
      cut.other_motion = motion;
    }
  }
  return cut;
}

std::vector<Cut> weakest_cuts(const PairGraph& graph, const Component& component) {
  const std::vector<Edge> tree = spanning_tree(graph, component);
  std::set<std::vector<std::size_t>> parts;
  for (std::size_t k = 0; k < tree.size(); ++k) parts.insert(beyond(tree, k, component.reference, component));
  for (const std::size_t i : component.members()) {
    if (i != component.reference) parts.insert({i});
  }
  std::vector<Cut> cuts;
  for (const auto& part : parts) {
    if (!part.empty()) cuts.push_back(measure_cut(graph, component, part));
  }
  return cuts;
}

}  // namespace tcm_icp
