#include "inference/implied_poses.hpp"

#include <algorithm>

namespace tcm_icp {
namespace {

bool agrees(const PairGraph& graph, std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) {
  for (const std::size_t k : graph.pairs_of(a)) {
    const ComparedPair& pair = graph.pairs()[k];
    if (pair.a != a || pair.b != b) continue;
    return std::any_of(pair.hypotheses.begin(), pair.hypotheses.end(),
                       [&](const PoseHypothesis& h) { return graph.same_pose(b, T_a_b, h.T_a_b); });
  }
  return false;
}

}  // namespace

std::vector<ImpliedPose> implied_poses(
    const PairGraph& graph, const Component& component, const std::vector<Cut>& cuts, double clear_lead,
    const std::function<bool(std::size_t, std::size_t, const Eigen::Isometry3d&)>& may_overlap) {
  std::vector<ImpliedPose> out;
  std::size_t configuration = 0;
  const auto imply = [&](std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) {
    if (may_overlap(a, b, T_a_b)) out.push_back({a, b, T_a_b, agrees(graph, a, b, T_a_b), configuration});
  };
  const std::vector<std::size_t> members = component.members();
  const auto& T = component.T_reference_scan;
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (std::size_t j = i + 1; j < members.size(); ++j) {
      imply(members[i], members[j], T[members[i]]->inverse() * *T[members[j]]);
    }
  }
  for (const Cut& cut : cuts) {
    if (!cut.other_motion || cut.lead() >= clear_lead) continue;
    ++configuration;
    for (const std::size_t i : cut.moved) {
      const Eigen::Isometry3d T_moved = *cut.other_motion * *T[i];
      for (const std::size_t j : members) {
        if (cut.moves(j)) continue;
        if (i < j) {
          imply(i, j, T_moved.inverse() * *T[j]);
        } else {
          imply(j, i, T[j]->inverse() * T_moved);
        }
      }
    }
  }
  return out;
}

}  // namespace tcm_icp
