#include "report/weak_spots.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace tcm_icp {
namespace {

class Graph {
 public:
  Graph(const std::vector<std::size_t>& nodes, const std::vector<WeightedLink>& links) : nodes_(nodes), links_(links) {
    for (std::size_t k = 0; k < links.size(); ++k) {
      const auto a = place(links[k].a), b = place(links[k].b);
      if (a && b && *a != *b) edges_.push_back({*a, *b, k});
    }
    std::vector<Edge> all = edges_;  // links that weigh nothing count where nothing else connects
    std::erase_if(edges_, [&](const Edge& e) { return links[e.link].weight <= 0; });
    if (!is_connected()) edges_ = std::move(all);
  }

  bool is_connected() const {
    const std::vector<bool> reached = reached_without(links_.size());
    return std::find(reached.begin(), reached.end(), false) == reached.end();
  }

  // What can be reached from the first node without one link.
  std::vector<bool> reached_without(std::size_t left_out) const {
    std::vector<bool> reached(nodes_.size(), false);
    if (nodes_.empty()) return reached;
    reached[0] = true;
    for (bool grows = true; grows;) {
      grows = false;
      for (const auto& [a, b, k] : edges_) {
        if (k == left_out || reached[a] == reached[b]) continue;
        reached[a] = reached[b] = true;
        grows = true;
      }
    }
    return reached;
  }

  std::vector<WeakSpot> bridges() const {
    std::vector<WeakSpot> out;
    for (const auto& [a, b, k] : edges_) {
      const std::vector<bool> side = reached_without(k);
      if (std::find(side.begin(), side.end(), false) != side.end()) out.push_back(spot(side));
    }
    return out;
  }

  // Stoer and Wagner: the last node of each phase, with what was merged into it, against all others.
  WeakSpot least_cut() const {
    const auto n = static_cast<Eigen::Index>(nodes_.size());
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(n, n);
    for (const auto& [a, b, k] : edges_) {
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
      weight(i, j) += links_[k].weight;
      weight(j, i) += links_[k].weight;
    }
    std::vector<std::vector<std::size_t>> merged(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) merged[i] = {i};
    std::vector<Eigen::Index> alive(nodes_.size());
    std::iota(alive.begin(), alive.end(), Eigen::Index{0});
    double least = std::numeric_limits<double>::infinity();
    std::vector<bool> best(nodes_.size(), false);
    while (alive.size() > 1) {
      std::vector<Eigen::Index> rest = alive;
      Eigen::VectorXd to_those_taken = Eigen::VectorXd::Zero(n);
      Eigen::Index last = -1, before = -1;
      while (!rest.empty()) {
        const auto most = std::max_element(rest.begin(), rest.end(), [&](Eigen::Index i, Eigen::Index j) {
          return to_those_taken[i] < to_those_taken[j];
        });
        before = last;
        last = *most;
        rest.erase(most);
        if (rest.empty()) break;
        for (const Eigen::Index i : rest) to_those_taken[i] += weight(last, i);
      }
      if (to_those_taken[last] < least) {
        least = to_those_taken[last];
        best.assign(nodes_.size(), false);
        for (const std::size_t i : merged[static_cast<std::size_t>(last)]) best[i] = true;
      }
      auto& into = merged[static_cast<std::size_t>(before)];
      const auto& from = merged[static_cast<std::size_t>(last)];
      into.insert(into.end(), from.begin(), from.end());
      weight.row(before) += weight.row(last);
      weight.col(before) += weight.col(last);
      alive.erase(std::find(alive.begin(), alive.end(), last));
    }
    return spot(best);
  }

 private:
  struct Edge {
    std::size_t a, b, link;
  };

  std::optional<std::size_t> place(std::size_t scan) const {
    const auto at = std::find(nodes_.begin(), nodes_.end(), scan);
    if (at == nodes_.end()) return std::nullopt;
    return static_cast<std::size_t>(at - nodes_.begin());
  }

  WeakSpot spot(const std::vector<bool>& side) const {
    const auto count = static_cast<std::size_t>(std::count(side.begin(), side.end(), true));
    const bool smaller = 2 * count <= nodes_.size();
    WeakSpot out;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (side[i] == smaller) out.scans.push_back(nodes_[i]);
    }
    std::sort(out.scans.begin(), out.scans.end());
    for (const auto& [a, b, k] : edges_) {
      if (side[a] == side[b]) continue;
      out.links.push_back(k);
      out.weight += links_[k].weight;
    }
    std::stable_sort(out.links.begin(), out.links.end(),
                     [&](std::size_t a, std::size_t b) { return links_[a].weight > links_[b].weight; });
    return out;
  }

  const std::vector<std::size_t>& nodes_;
  const std::vector<WeightedLink>& links_;
  std::vector<Edge> edges_;
};

}  // namespace

std::vector<WeakSpot> weak_spots(const std::vector<std::size_t>& nodes, const std::vector<WeightedLink>& links) {
  if (nodes.size() < 2) return {};
  const Graph graph(nodes, links);
  if (!graph.is_connected()) return {};
  std::vector<WeakSpot> out = graph.bridges();
  if (out.empty()) out.push_back(graph.least_cut());
  std::stable_sort(out.begin(), out.end(), [](const WeakSpot& a, const WeakSpot& b) { return a.weight < b.weight; });
  return out;
}

}  // namespace tcm_icp
