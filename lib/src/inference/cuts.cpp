#include "inference/cuts.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <set>

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

// Minimum cuts between scans, by flows (Boykov and Kolmogorov).
class Flows {
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Graph = boost::adjacency_list<
      boost::vecS, boost::vecS, boost::directedS,
      boost::property<boost::vertex_color_t, boost::default_color_type,
                      boost::property<boost::vertex_distance_t, long,
                                      boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>,
      boost::property<boost::edge_capacity_t, double,
                      boost::property<boost::edge_residual_capacity_t, double,
                                      boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;

 public:
  Flows(const std::vector<Edge>& edges, std::size_t num_scans) : graph_(num_scans) {
    for (const Edge& e : edges) {
      const auto there = boost::add_edge(e.a, e.b, graph_).first, back = boost::add_edge(e.b, e.a, graph_).first;
      for (const auto& [edge, other] : {std::pair(there, back), std::pair(back, there)}) {
        boost::put(boost::edge_capacity, graph_, edge, e.support);
        boost::put(boost::edge_reverse, graph_, edge, other);
      }
    }
  }

  // Whether each scan is on the side of `from`.
  std::vector<bool> side_of(std::size_t from, std::size_t to) {
    boost::boykov_kolmogorov_max_flow(graph_, from, to);
    std::vector<bool> side(boost::num_vertices(graph_));
    for (std::size_t i = 0; i < side.size(); ++i) {
      side[i] = boost::get(boost::vertex_color, graph_, i) == boost::black_color;
    }
    return side;
  }

 private:
  Graph graph_;
};

// A minimum cut for each edge of a cut tree (Gusfield, 1990): among them is one between any two members. Each as the
// part without the reference.
std::vector<std::vector<std::size_t>> minimum_cuts(const std::vector<Edge>& edges, const Component& component) {
  const std::vector<std::size_t> members = component.members();
  Flows flows(edges, component.T_reference_scan.size());
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
  std::set<std::vector<std::size_t>> parts;
  for (auto& part : minimum_cuts(supported_pairs(graph, component), component)) parts.insert(std::move(part));
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
