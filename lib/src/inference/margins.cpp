#include "inference/margins.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace tcm_icp {
namespace {

std::vector<double> overlap_with_group(const PairGraph& graph, const std::vector<Component>& components,
                                       const std::vector<std::size_t>& groups) {
  std::vector<double> out(groups.size(), 0);
  for (const Component& component : components) {
    const auto& T = component.T_reference_scan;
    for (const std::size_t i : component.members()) {
      for (const std::size_t k : graph.pairs_of(i)) {
        const ComparedPair& pair = graph.pairs()[k];
        if (pair.a != i || groups[pair.a] != groups[pair.b]) continue;
        const Agreement found = graph.agreement(pair, *T[pair.a], *T[pair.b]);
        if (found.hypothesis == nullptr) continue;
        out[pair.a] += found.hypothesis->overlap;
        out[pair.b] += found.hypothesis->overlap;
      }
    }
  }
  return out;
}

}  // namespace

std::vector<std::size_t> margins_of_groups(const PairGraph& graph, const std::vector<Component>& components,
                                           const std::vector<std::size_t>& groups, std::size_t count) {
  const std::vector<double> overlap = overlap_with_group(graph, components, groups);
  std::vector<std::vector<std::size_t>> members(groups.size());  // of each group, the least overlapping first
  for (std::size_t i = 0; i < groups.size(); ++i) members[groups[i]].push_back(i);
  std::vector<std::size_t> rank(groups.size(), 0), out(groups.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  for (auto& group : members) {
    std::stable_sort(group.begin(), group.end(), [&](std::size_t x, std::size_t y) { return overlap[x] < overlap[y]; });
    for (std::size_t k = 0; k < group.size(); ++k) rank[group[k]] = k;
  }
  std::stable_sort(out.begin(), out.end(), [&](std::size_t x, std::size_t y) {
    const std::size_t size_x = members[groups[x]].size(), size_y = members[groups[y]].size();
    return std::tie(rank[x], size_y) < std::tie(rank[y], size_x);
  });
  out.resize(std::min(count, out.size()));
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace tcm_icp
