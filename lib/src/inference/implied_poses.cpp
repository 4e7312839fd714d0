#include "inference/implied_poses.hpp"

#include <algorithm>

namespace tcm_icp {
namespace {

bool agrees(const PairGraph& graph, std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) {
  for (const std::size_t k : graph.pairs_of(a)) {
    const ComparedPair& pair = graph.pairs()[k];
    if (pair.a != a || pair.b != b) continue;
    return std::any_of(pair.hypotheses.begin(), pair.hypotheses.end(),
                       [&](const PoseHypothesis& h) { return graph.is_fitted(b, T_a_b, h.T_a_b); });
  }
  return false;
}

// Poses of `scan` that likely hypotheses lead to which agree with where it is, and that a fit tells apart from it: as
// the other face of a wall is. Each once.
std::vector<Eigen::Isometry3d> poses_beside(const PairGraph& graph, const Component& component, std::size_t scan) {
  const Eigen::Isometry3d& T = *component.T_reference_scan[scan];
  std::vector<Eigen::Isometry3d> known{T};
  for (const std::size_t k : graph.pairs_of(scan)) {
    const ComparedPair& pair = graph.pairs()[k];
    const std::size_t other = pair.a == scan ? pair.b : pair.a;
    if (!component.has(other)) continue;
    for (const PoseHypothesis& h : pair.hypotheses) {
      if (h.log_odds <= 0) continue;
      const Eigen::Isometry3d T_there =
          *component.T_reference_scan[other] * (pair.a == scan ? h.T_a_b.inverse() : h.T_a_b);
      const auto is_fitted = [&](const Eigen::Isometry3d& U) { return graph.is_fitted(scan, U, T_there); };
      if (!graph.same_pose(scan, T, T_there) || std::any_of(known.begin(), known.end(), is_fitted)) continue;
      known.push_back(T_there);
    }
  }
  known.erase(known.begin());
  return known;
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
  const auto imply_moved = [&](std::size_t i, const Eigen::Isometry3d& T_moved, std::size_t j) {
    if (i < j) {
      imply(i, j, T_moved.inverse() * *T[j]);
    } else {
      imply(j, i, T[j]->inverse() * T_moved);
    }
  };
  for (const std::size_t i : members) {
    for (const Eigen::Isometry3d& T_beside : poses_beside(graph, component, i)) {
      ++configuration;
      for (const std::size_t j : members) {
        if (j != i) imply_moved(i, T_beside, j);
      }
    }
  }
  for (const Cut& cut : cuts) {
    if (!cut.other_motion || cut.lead() >= clear_lead) continue;
    ++configuration;
    for (const std::size_t i : cut.moved) {
      for (const std::size_t j : members) {
        if (!cut.moves(j)) imply_moved(i, *cut.other_motion * *T[i], j);
      }
    }
  }
  return out;
}

}  // namespace tcm_icp
