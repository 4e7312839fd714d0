#include "inference/cuts.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

struct Edge {
  double support;
  std::size_t a, b;
};

std::vector<Edge> supported_pairs(const PairGraph& graph, const Component& component) {
  std::vector<Edge> edges;
  for (const ComparedPair& pair : graph.pairs()) {
    if (!component.has(pair.a) || !component.has(pair.b)) continue;
    const double support =
        graph.support(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]);
    if (support > 0) edges.push_back({support, pair.a, pair.b});
  }
  return edges;
}

// Maximum flows between scans over the pairs' support, along shortest paths (Edmonds and Karp, 1972).
class Flows {
 public:
  Flows(const std::vector<Edge>& edges, std::size_t num_scans) : edges_(edges), of_scan_(num_scans) {
    for (std::size_t k = 0; k < edges.size(); ++k) {
      of_scan_[edges[k].a].push_back(k);
      of_scan_[edges[k].b].push_back(k);
    }
  }

  /// Whether each scan is on the side of `from` in a minimum cut between the two.
  std::vector<bool> side_of(std::size_t from, std::size_t to) const {
    std::vector<double> flow(edges_.size(), 0);  // from a to b
    while (true) {
      const std::vector<std::size_t> way = shortest_ways(flow, from, to);
      if (way[to] == kNone) {
        std::vector<bool> side(of_scan_.size(), false);
        for (std::size_t i = 0; i < side.size(); ++i) side[i] = i == from || way[i] != kNone;
        return side;
      }
      double least = std::numeric_limits<double>::infinity();
      for_each_edge_to(to, from, way, [&](std::size_t k, std::size_t i) { least = std::min(least, left(flow, k, i)); });
      for_each_edge_to(to, from, way,
                       [&](std::size_t k, std::size_t i) { flow[k] += i == edges_[k].a ? least : -least; });
    }
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  static constexpr double kLeastLeft = 1e-9;  // less is rounding

  // What edge k still takes on from scan i.
  double left(const std::vector<double>& flow, std::size_t k, std::size_t i) const {
    return edges_[k].support - (i == edges_[k].a ? flow[k] : -flow[k]);
  }
  std::size_t other_end(std::size_t k, std::size_t i) const { return edges_[k].a == i ? edges_[k].b : edges_[k].a; }

  // The edge by which each scan is reached first; those of scans farther than `to` are of no use where that is reached.
  std::vector<std::size_t> shortest_ways(const std::vector<double>& flow, std::size_t from, std::size_t to) const {
    std::vector<std::size_t> way(of_scan_.size(), kNone), open{from};
    for (std::size_t next = 0; next < open.size(); ++next) {
      const std::size_t i = open[next];
      for (const std::size_t k : of_scan_[i]) {
        const std::size_t j = other_end(k, i);
        if (j == from || way[j] != kNone || left(flow, k, i) <= kLeastLeft) continue;
        way[j] = k;
        if (j == to) return way;
        open.push_back(j);
      }
    }
    return way;
  }

  // Backwards from `to`: each edge with the scan it is entered from.
  template <typename Visit>
  void for_each_edge_to(std::size_t to, std::size_t from, const std::vector<std::size_t>& way, Visit visit) const {
    for (std::size_t j = to; j != from;) {
      const std::size_t k = way[j], i = other_end(k, j);
      visit(k, i);
      j = i;
    }
  }

  const std::vector<Edge>& edges_;
  std::vector<std::vector<std::size_t>> of_scan_;
};

// A minimum cut for each edge of a cut tree (Gusfield, 1990): among them is one between any two members. Each as the
// part without the reference.
std::vector<std::vector<std::size_t>> minimum_cuts(const std::vector<Edge>& edges, const Component& component) {
  const std::vector<std::size_t> members = component.members();
  const Flows flows(edges, component.T_reference_scan.size());
  std::vector<std::size_t> parent(component.T_reference_scan.size(), members.front());
  std::vector<std::vector<std::size_t>> cuts;
  for (std::size_t k = 1; k < members.size(); ++k) {
    const std::size_t i = members[k];
    const std::vector<bool> side = flows.side_of(i, parent[i]);
    for (std::size_t l = k + 1; l < members.size(); ++l) {
      const std::size_t j = members[l];
      if (side[j] && parent[j] == parent[i]) parent[j] = i;
    }
    std::vector<std::size_t> part;
    for (const std::size_t j : members) {
      if (side[j] != side[component.reference]) part.push_back(j);
    }
    cuts.push_back(std::move(part));
  }
  return cuts;
}

}  // namespace

namespace {

struct PairAcross {
  const ComparedPair* pair;
  bool moves_b;
};

// Where a hypothesis of a pair across a cut puts the middle of b tells at little cost which motions it agrees with. Of
// all pairs in one row: a cut of a large set has hundreds of them, and each hypothesis is a motion to ask all about.
struct MiddleAcross {
  Eigen::Vector3d middle_b;  ///< in the reference's frame, at the poses as they are
  Eigen::Vector3d supposed;  ///< by the hypothesis, with a at its pose
  std::size_t pair;          ///< its place in the row of pairs
};

struct PairsAcross {
  std::vector<PairAcross> pairs;
  std::vector<MiddleAcross> middles;  ///< in the order of the pairs
};

PairsAcross pairs_across(const PairGraph& graph, const Component& component, const std::vector<std::size_t>& moved) {
  std::vector<bool> is_moved(graph.num_scans(), false);
  for (const std::size_t i : moved) is_moved[i] = true;
  PairsAcross across;
  for (const std::size_t i : moved) {
    for (const std::size_t k : graph.pairs_of(i)) {
      const ComparedPair& pair = graph.pairs()[k];
      const std::size_t other = pair.a == i ? pair.b : pair.a;
      if (!component.has(other) || is_moved[other]) continue;
      const Eigen::Isometry3d &T_a = *component.T_reference_scan[pair.a], &T_b = *component.T_reference_scan[pair.b];
      const Eigen::Vector3d middle_b = T_b * graph.mean_of(pair.b);
      for (const PoseHypothesis& h : pair.hypotheses) {
        across.middles.push_back({middle_b, T_a * h.mean, across.pairs.size()});
      }
      across.pairs.push_back({&pair, pair.b == i});
    }
  }
  return across;
}

double support_across(const PairGraph& graph, const Component& component, const PairsAcross& across,
                      const Eigen::Isometry3d& motion) {
  const Eigen::Isometry3d back = motion.inverse();
  double sum = -graph.options().log_poses;
  std::size_t next = 0;  // the first pair that was not asked yet
  for (const MiddleAcross& m : across.middles) {
    if (m.pair < next) continue;
    const PairAcross& p = across.pairs[m.pair];
    if (!graph.same_mean(m.supposed, (p.moves_b ? motion : back) * m.middle_b)) continue;
    next = m.pair + 1;
    const Eigen::Isometry3d &T_a = *component.T_reference_scan[p.pair->a],
                            &T_b = *component.T_reference_scan[p.pair->b];
    sum += p.moves_b ? graph.support(*p.pair, T_a, motion * T_b) : graph.support(*p.pair, motion * T_a, T_b);
  }
  return sum;
}

}  // namespace

Cut measure_cut(const PairGraph& graph, const Component& component, std::vector<std::size_t> moved) {
  Cut cut{std::move(moved), 0, 0, std::nullopt};
  const PairsAcross across = pairs_across(graph, component, cut.moved);
  cut.support = support_across(graph, component, across, Eigen::Isometry3d::Identity());
  for (const PairAcross& p : across.pairs) {
    const std::size_t scan = p.moves_b ? p.pair->b : p.pair->a, fixed = p.moves_b ? p.pair->a : p.pair->b;
    const Eigen::Isometry3d &T_scan = *component.T_reference_scan[scan], &T_fixed = *component.T_reference_scan[fixed];
    for (const PoseHypothesis& h : p.pair->hypotheses) {
      const Eigen::Isometry3d T_elsewhere = T_fixed * (p.moves_b ? h.T_a_b : h.T_a_b.inverse());
      if (graph.same_pose(scan, T_scan, T_elsewhere)) continue;
      const Eigen::Isometry3d motion = T_elsewhere * T_scan.inverse();
      const double other = support_across(graph, component, across, motion);
      if (cut.other_motion && other <= cut.other_support) continue;
      cut.other_support = other;
      cut.other_motion = motion;
    }
  }
  return cut;
}

double measure_support(const PairGraph& graph, const Component& component, const std::vector<std::size_t>& moved) {
  return support_across(graph, component, pairs_across(graph, component, moved), Eigen::Isometry3d::Identity());
}

double most_elsewhere(const PairGraph& graph, const Component& component, const std::vector<std::size_t>& moved) {
  double sum = -graph.options().log_poses;
  for (const PairAcross& p : pairs_across(graph, component, moved).pairs) {
    double most = 0;
    for (const PoseHypothesis& h : p.pair->hypotheses) {
      const Eigen::Isometry3d &T_a = *component.T_reference_scan[p.pair->a],
                              &T_b = *component.T_reference_scan[p.pair->b];
      if (!graph.same_pose(p.pair->b, T_b, T_a * h.T_a_b)) most = std::max(most, graph.most_support(h));
    }
    sum += most;
  }
  return sum;
}

std::vector<std::size_t> frontier(const PairGraph& graph, const Component& component, const Cut& cut) {
  const auto& T = component.T_reference_scan;
  std::vector<std::size_t> out;
  for (const std::size_t i : cut.moved) {
    const auto& pairs = graph.pairs_of(i);
    const bool holds = std::any_of(pairs.begin(), pairs.end(), [&](std::size_t k) {
      const ComparedPair& pair = graph.pairs()[k];
      const std::size_t other = pair.a == i ? pair.b : pair.a;
      return component.has(other) && !cut.moves(other) && graph.support(pair, *T[pair.a], *T[pair.b]) > 0;
    });
    if (holds) out.push_back(i);
  }
  return out.empty() ? cut.moved : out;
}

std::vector<std::size_t> clear_groups(const std::vector<Component>& components,
                                      const std::vector<std::vector<Cut>>& cuts, double clear_lead,
                                      std::size_t num_scans) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> group(num_scans, kNone);
  std::size_t num_groups = 0;
  for (std::size_t c = 0; c < components.size(); ++c) {
    std::map<std::vector<bool>, std::size_t> of_sides;  // which side of each weak cut
    for (const std::size_t i : components[c].members()) {
      std::vector<bool> sides;
      for (const Cut& cut : cuts[c]) {
        if (cut.lead() < clear_lead) sides.push_back(cut.moves(i));
      }
      const auto [known, is_new] = of_sides.try_emplace(std::move(sides), num_groups);
      if (is_new) ++num_groups;
      group[i] = known->second;
    }
  }
  for (std::size_t& g : group) {
    if (g == kNone) g = num_groups++;
  }
  return group;
}

double lead_between(const std::vector<Cut>& cuts, std::size_t a, std::size_t b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts) {
    if (cut.moves(a) != cut.moves(b)) least = std::min(least, cut.lead());
  }
  return least;
}

std::vector<std::vector<std::size_t>> weakest_parts(const PairGraph& graph, const Component& component) {
  std::set<std::vector<std::size_t>> parts;
  for (auto& part : minimum_cuts(supported_pairs(graph, component), component)) {
    if (!part.empty()) parts.insert(std::move(part));
  }
  return {parts.begin(), parts.end()};
}

std::vector<Cut> weakest_cuts(const PairGraph& graph, const Component& component, int num_threads) {
  std::set<std::vector<std::size_t>> parts;
  for (auto& part : weakest_parts(graph, component)) parts.insert(std::move(part));
  for (const std::size_t i : component.members()) {
    if (i != component.reference) parts.insert({i});
  }
  const std::vector<std::vector<std::size_t>> row(parts.begin(), parts.end());
  std::vector<Cut> cuts(row.size());
  parallel_for(num_threads, row.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) cuts[k] = measure_cut(graph, component, row[k]);
  });
  return cuts;
}

}  // namespace tcm_icp
