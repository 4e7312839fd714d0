#include "inference/pairs_across.hpp"

#include <algorithm>
#include <numeric>

#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

PairsAcross::PairsAcross(const PairGraph& graph, const Component& component, const std::vector<std::size_t>& moved)
    : graph_(graph), component_(component) {
  std::vector<bool> is_moved(graph.num_scans(), false);
  for (const std::size_t i : moved) is_moved[i] = true;
  for (const std::size_t i : moved) {
    for (const std::size_t k : graph.pairs_of(i)) {
      const ComparedPair& pair = graph.pairs()[k];
      const std::size_t other = pair.a == i ? pair.b : pair.a;
      if (!component.has(other) || is_moved[other]) continue;
      double most_support = 0;
      for (const PoseHypothesis& h : pair.hypotheses) {
        hypotheses_.push_back({&h, pairs_.size(), pose(pair.a) * h.mean});
        most_support = std::max(most_support, graph.most_support(h));
      }
      pairs_.push_back({&pair, pair.b == i, most_support, pose(pair.b) * graph.mean_of(pair.b)});
    }
  }
}

Eigen::Isometry3d PairsAcross::motion_by(const Hypothesis& h) const {
  const Pair& p = pairs_[h.pair];
  const Eigen::Isometry3d T = pose(p.pair->a) * h.hypothesis->T_a_b * pose(p.pair->b).inverse();
  return p.moves_b ? T : T.inverse();
}

bool PairsAcross::is_elsewhere(const Hypothesis& h) const {
  const Pair& p = pairs_[h.pair];
  const Eigen::Isometry3d &T_a = pose(p.pair->a), &T_b = pose(p.pair->b), &T_a_b = h.hypothesis->T_a_b;
  return p.moves_b ? !graph_.same_pose(p.pair->b, T_b, T_a * T_a_b)
                   : !graph_.same_pose(p.pair->a, T_a, T_b * T_a_b.inverse());
}

double PairsAcross::support_of(const Pair& p, const Eigen::Isometry3d& motion) const {
  const Eigen::Isometry3d &T_a = pose(p.pair->a), &T_b = pose(p.pair->b);
  return p.moves_b ? graph_.support(*p.pair, T_a, motion * T_b) : graph_.support(*p.pair, motion * T_a, T_b);
}

double PairsAcross::support(const Eigen::Isometry3d& motion) const {
  std::vector<std::size_t> all(hypotheses_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return support(motion, all);
}

double PairsAcross::support(const Eigen::Isometry3d& motion, const std::vector<std::size_t>& indices) const {
  const Eigen::Isometry3d back = motion.inverse();
  double sum = -graph_.options().log_poses;
  std::size_t next = 0;  // the first pair that was not asked yet
  for (const std::size_t k : indices) {
    const Hypothesis& h = hypotheses_[k];
    if (h.pair < next) continue;
    const Pair& p = pairs_[h.pair];
    // Where the middle of b lies tells at little cost whether the hypothesis agrees.
    if (!graph_.same_mean(h.middle_b, (p.moves_b ? motion : back) * p.middle_b)) continue;
    next = h.pair + 1;
    sum += support_of(p, motion);
  }
  return sum;
}

PairsAcross::Elsewhere PairsAcross::best_elsewhere() const {
  Elsewhere best;
  if (hypotheses_.empty()) return best;
  // Motions that agree put the middle of the part at places near to one another.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Pair& p : pairs_) {
    middle += pose(p.moves_b ? p.pair->b : p.pair->a) * graph_.mean_of(p.moves_b ? p.pair->b : p.pair->a);
  }
  middle /= static_cast<double>(pairs_.size());
  std::vector<Eigen::Isometry3d> motions;
  Points places;
  double reach_m = 0;
  for (const Hypothesis& h : hypotheses_) {
    const Pair& p = pairs_[h.pair];
    motions.push_back(motion_by(h));
    places.push_back(motions.back() * middle);
    const Eigen::Vector3d& middle_b = p.moves_b ? p.middle_b : h.middle_b;  // before it moves
    reach_m = std::max(reach_m, graph_.farthest_as_one(p.pair->b, (middle_b - middle).norm()));
  }
  const NeighborIndex index(places);
  std::vector<Neighbor> near;
  std::vector<std::size_t> indices;
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
    if (!is_elsewhere(hypotheses_[k])) continue;
    index.within(places[k], reach_m, near);
    indices.clear();
    for (const Neighbor& n : near) indices.push_back(n.index);
    std::sort(indices.begin(), indices.end());
    if (best.motion && most_support(indices) <= best.support) continue;
    const double found = support(motions[k], indices);
    if (best.motion && found <= best.support) continue;
    best = {found, motions[k]};
  }
  return best;
}

double PairsAcross::most_support(const std::vector<std::size_t>& indices) const {
  double sum = -graph_.options().log_poses;
  std::size_t next = 0;
  for (const std::size_t k : indices) {
    const Hypothesis& h = hypotheses_[k];
    if (h.pair < next) continue;
    next = h.pair + 1;
    sum += pairs_[h.pair].most_support;
  }
  return sum;
}

double PairsAcross::most_elsewhere() const {
  double sum = -graph_.options().log_poses, most = 0;
  std::size_t pair = 0;
  for (const Hypothesis& h : hypotheses_) {
    if (h.pair != pair) {
      sum += most;
      most = 0;
      pair = h.pair;
    }
    if (is_elsewhere(h)) most = std::max(most, graph_.most_support(*h.hypothesis));
  }
  return sum + most;
}

}  // namespace tcm_icp
