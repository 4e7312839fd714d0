#include "tcm_icp/baselines/spanning_tree.hpp"

#include <algorithm>
#include <numeric>

#include "tcm_icp/graph/correspondence_graph.hpp"

namespace tcm_icp {

std::vector<std::size_t> maximum_spanning_tree(std::size_t num_scans, const std::vector<PairFit>& pairs) {
  std::vector<std::size_t> order(pairs.size()), group(num_scans), tree;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::iota(group.begin(), group.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (pairs[a].share != pairs[b].share) return pairs[a].share > pairs[b].share;
    return pairs[a].mean_distance_m < pairs[b].mean_distance_m;
  });
  for (const std::size_t k : order) {
    const std::size_t to = group[pairs[k].target], from = group[pairs[k].source];
    if (to == from) continue;
    std::replace(group.begin(), group.end(), from, to);
    tree.push_back(k);
  }
  return tree;
}

std::size_t tree_reference(std::size_t num_scans, const std::vector<PairFit>& pairs,
                           const std::vector<std::size_t>& tree) {
  std::vector<std::vector<std::size_t>> adjacency(num_scans);
  for (const std::size_t k : tree) {
    adjacency[pairs[k].source].push_back(pairs[k].target);
    adjacency[pairs[k].target].push_back(pairs[k].source);
  }
  return choose_reference(adjacency);
}

std::vector<std::optional<Eigen::Isometry3d>> poses_along_tree(std::size_t num_scans, const std::vector<PairFit>& pairs,
                                                               const std::vector<std::size_t>& tree,
                                                               std::size_t reference) {
  std::vector<std::optional<Eigen::Isometry3d>> poses(num_scans);
  poses[reference] = Eigen::Isometry3d::Identity();
  for (bool grown = true; grown;) {
    grown = false;
    for (const std::size_t k : tree) {
      auto &source = poses[pairs[k].source], &target = poses[pairs[k].target];
      if (source.has_value() == target.has_value()) continue;
      if (target) {
        source = *target * pairs[k].T_target_source;
      } else {
        target = *source * pairs[k].T_target_source.inverse();
      }
      grown = true;
    }
  }
  return poses;
}

}  // namespace tcm_icp
