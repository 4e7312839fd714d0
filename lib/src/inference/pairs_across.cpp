#include "inference/pairs_across.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tcm_icp {

PairsAcross::PairsAcross(const PairGraph& graph, const Component& component, const AlikeParts& alike,
                         const std::vector<std::size_t>& moved)
    : graph_(graph), component_(component) {
  std::vector<bool> is_moved(graph.num_scans(), false);
  for (const std::size_t i : moved) is_moved[i] = true;
  std::vector<std::size_t> across;
  for (const std::size_t i : moved) {
    for (const std::size_t k : graph.pairs_of(i)) {
      const ComparedPair& pair = graph.pairs()[k];
      const std::size_t other = pair.a == i ? pair.b : pair.a;
      if (!component.has(other) || is_moved[other]) continue;
      across.push_back(k);
      double most_support = 0;
      for (const PoseHypothesis& h : pair.hypotheses) {
        hypotheses_.push_back({&h, pairs_.size(), pose(pair.a) * h.mean});
        most_support = std::max(most_support, h.most_support);
      }
      pairs_.push_back(
          {&pair, pair.b == i, most_support, alike.less_said(pair.a, pair.b), pose(pair.b) * graph.mean_of(pair.b)});
    }
  }
  std::sort(across.begin(), across.end());
  taught_by_others_ = graph.constant_without(across);
}

Eigen::Isometry3d PairsAcross::motion_by(const Hypothesis& h) const {
  const Pair& p = pairs_[h.pair];
  const Eigen::Isometry3d T = pose(p.pair->a) * h.hypothesis->T_a_b * pose(p.pair->b).inverse();
  return p.moves_b ? T : T.inverse();
}

bool PairsAcross::is_at(const Hypothesis& h, const Eigen::Isometry3d& motion) const {
  const Pair& p = pairs_[h.pair];
  const Eigen::Isometry3d &T_a = pose(p.pair->a), &T_b = pose(p.pair->b), &T_a_b = h.hypothesis->T_a_b;
  return p.moves_b ? graph_.same_pose(p.pair->b, motion * T_b, T_a * T_a_b)
                   : graph_.same_pose(p.pair->a, motion * T_a, T_b * T_a_b.inverse());
}

bool PairsAcross::is_elsewhere(const Hypothesis& h) const { return !is_at(h, Eigen::Isometry3d::Identity()); }

SupportAcross PairsAcross::support_of(const Pair& p, const Eigen::Isometry3d& motion) const {
  const Eigen::Isometry3d &T_a = pose(p.pair->a), &T_b = pose(p.pair->b);
  return p.moves_b ? graph_.support_across(*p.pair, T_a, motion * T_b, taught_by_others_, p.alike)
                   : graph_.support_across(*p.pair, motion * T_a, T_b, taught_by_others_, p.alike);
}

bool PairsAcross::may_agree(const Hypothesis& h, const Eigen::Isometry3d& motion, const Eigen::Isometry3d& back) const {
  const Pair& p = pairs_[h.pair];
  return graph_.same_mean(h.middle_b, (p.moves_b ? motion : back) * p.middle_b);
}

double PairsAcross::support(const Eigen::Isometry3d& motion) const {
  const Eigen::Isometry3d back = motion.inverse();
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
    if (may_agree(hypotheses_[k], motion, back)) found.push_back(k);
  }
  return support(motion, found);
}

double PairsAcross::support(const Eigen::Isometry3d& motion, const std::vector<std::size_t>& may_agree) const {
  double sum = -graph_.options().log_poses, against_twins = graph_.options().log_twins;
  std::size_t next = 0;  // the first pair that was not asked yet
  for (const std::size_t k : may_agree) {
    const std::size_t pair = hypotheses_[k].pair;
    if (pair < next) continue;
    next = pair + 1;
    const SupportAcross says = support_of(pairs_[pair], motion);
    sum += says.support;
    against_twins += says.against_twins;
  }
  return std::min(sum, against_twins);
}

double PairsAcross::most_support(const std::vector<std::size_t>& may_agree) const {
  double sum = -graph_.options().log_poses;
  std::size_t next = 0;
  for (const std::size_t k : may_agree) {
    const std::size_t pair = hypotheses_[k].pair;
    if (pair < next) continue;
    next = pair + 1;
    sum += pairs_[pair].most_support;
  }
  return sum;
}

MotionCells PairsAcross::cells(const std::vector<Eigen::Isometry3d>& motions) const {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Pair& p : pairs_) {
    middle += pose(p.moves_b ? p.pair->b : p.pair->a) * graph_.mean_of(p.moves_b ? p.pair->b : p.pair->a);
  }
  middle /= static_cast<double>(pairs_.size());
  // How far apart motions that agree put the middle of the part, and how differently they turn a direction.
  double reach_m = 0, reach_turn = 0;
  for (const Hypothesis& h : hypotheses_) {
    const Pair& p = pairs_[h.pair];
    const Eigen::Vector3d& middle_b = p.moves_b ? p.middle_b : h.middle_b;  // before it moves
    reach_m = std::max(reach_m, graph_.farthest_as_one(p.pair->b, (middle_b - middle).norm()));
    reach_turn = std::max(reach_turn, graph_.most_turn_as_one(p.pair->b));
  }
  const auto num_motions = static_cast<Eigen::Index>(motions.size());
  Eigen::Matrix3Xd places(3, num_motions);
  Eigen::Matrix<double, 9, Eigen::Dynamic> turns(9, num_motions);
  for (Eigen::Index k = 0; k < num_motions; ++k) {
    const Eigen::Isometry3d& motion = motions[static_cast<std::size_t>(k)];
    places.col(k) = motion * middle / reach_m;
    turns.col(k) = Eigen::Matrix3d(motion.linear() / reach_turn).reshaped();
  }
  // By two coordinates of the place and one of the turn: sets mostly lie flat.
  const auto spread = [](const auto& at) -> Eigen::VectorXd {
    return (at.colwise() - at.rowwise().mean()).rowwise().squaredNorm();
  };
  Eigen::Index turn = 0, flat = 0;
  spread(turns).maxCoeff(&turn);
  spread(places).minCoeff(&flat);
  places.row(flat) = turns.row(turn);
  return MotionCells(places);
}

std::vector<PairsAcross::CellPromise> PairsAcross::promises(const MotionCells& cells, double least) const {
  std::vector<double> most(cells.size(), 0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const std::size_t k : cells.motions(c)) {
      most[c] += std::max(0.0, hypotheses_[k].hypothesis->most_support);
    }
  }
  std::vector<CellPromise> out;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    double sum = -graph_.options().log_poses;
    for (const std::size_t near : cells.around(c)) sum += most[near];
    if (sum > least) out.push_back({c, sum});
  }
  std::stable_sort(out.begin(), out.end(), [](const CellPromise& x, const CellPromise& y) { return x.most > y.most; });
  return out;
}

PairsAcross::Elsewhere PairsAcross::best_elsewhere(double least) const {
  Elsewhere best{least, std::nullopt};
  if (hypotheses_.empty()) return best;
  std::vector<Eigen::Isometry3d> motions;
  for (const Hypothesis& h : hypotheses_) motions.push_back(motion_by(h));
  const MotionCells cells = this->cells(motions);
  std::vector<std::size_t> near, found;
  for (const CellPromise& promise : promises(cells, least)) {
    if (promise.most <= best.support) break;
    near.clear();
    for (const std::size_t c : cells.around(promise.cell)) {
      near.insert(near.end(), cells.motions(c).begin(), cells.motions(c).end());
    }
    std::sort(near.begin(), near.end());
    for (const std::size_t k : cells.motions(promise.cell)) {
      if (!is_elsewhere(hypotheses_[k])) continue;
      const Eigen::Isometry3d back = motions[k].inverse();
      found.clear();
      std::copy_if(near.begin(), near.end(), std::back_inserter(found),
                   [&](std::size_t j) { return may_agree(hypotheses_[j], motions[k], back); });
      if (most_support(found) <= best.support) continue;
      const double supported = support(motions[k], found);
      if (supported > best.support) best = {supported, motions[k]};
    }
  }
  return best;
}

std::vector<bool> PairsAcross::scans_that_hold() const {
  std::vector<bool> out(graph_.num_scans(), false);
  const Eigen::Isometry3d none = Eigen::Isometry3d::Identity();
  for (const Hypothesis& h : hypotheses_) {
    const Pair& p = pairs_[h.pair];
    const bool known = out[p.pair->a] && out[p.pair->b];
    if (!known && may_agree(h, none, none) && support_of(p, none).support > 0) out[p.pair->a] = out[p.pair->b] = true;
  }
  return out;
}

double PairsAcross::odds_elsewhere(const std::optional<Eigen::Isometry3d>& but) const {
  const std::vector<bool> holds = scans_that_hold();
  double sum = 0;
  for (const Hypothesis& h : hypotheses_) {
    const ComparedPair& pair = *pairs_[h.pair].pair;
    if (!holds[pair.a] && !holds[pair.b]) continue;
    if (is_elsewhere(h) && !(but && is_at(h, *but))) sum += std::exp(h.hypothesis->log_odds);
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
    if (is_elsewhere(h)) most = std::max(most, h.hypothesis->most_support);
  }
  return sum + most;
}

}  // namespace tcm_icp
