#pragma once
// The evidence between a part of a component, which moves as one, and the rest of it.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "inference/alike_parts.hpp"
#include "inference/compared_pairs.hpp"
#include "inference/motion_cells.hpp"

namespace tcm_icp {

/// Keeps references to graph and component, which must outlive it and not change.
class PairsAcross {
 public:
  /// @param alike  of the component
  /// @param moved         members of the component
  PairsAcross(const PairGraph& graph, const Component& component, const AlikeParts& alike,
              const std::vector<std::size_t>& moved);

  /// What the pairs say for the part at motion * T, T its poses in the component: against places that agree by chance,
  /// less log_poses, or against a twin, which is rarer by log_twins, whichever is less. Of a pair between parts that
  /// are twins (AlikeParts) agreement says less against a twin (log_alike). Cost: the hypotheses of the pairs.
  double support(const Eigen::Isometry3d& motion) const;

  struct Elsewhere {
    double support = 0;
    std::optional<Eigen::Isometry3d> motion;  ///< none where none is supported enough
  };
  /// Of the motions that a hypothesis leads to by which its scan leaves its pose, the one that is supported most, where
  /// that is more than `least`. Cost: of the motions, those ask that have enough like them, and those alone.
  Elsewhere best_elsewhere(double least) const;

  /// That one of the hypotheses is right by which a scan leaves its pose, but for those that agree with the motion
  /// `but`: the sum of their odds. Of the scans that pairs hold across: how many others either side has, and that were
  /// compared in vain, says nothing. Cost: the hypotheses of the pairs.
  double odds_elsewhere(const std::optional<Eigen::Isometry3d>& but) const;

  /// No less than the support of any motion that leaves no pair at its pose. Cost: the hypotheses of the pairs.
  double most_elsewhere() const;

 private:
  struct Pair {
    const ComparedPair* pair;
    bool moves_b;
    double most_support;       // of any of its hypotheses
    double alike;              // by how much less it says against twins
    Eigen::Vector3d middle_b;  // of b's points, in the reference's frame
  };
  // By a hypothesis, which is a motion of the part, with the other scan of its pair at its pose.
  struct Hypothesis {
    const PoseHypothesis* hypothesis;
    std::size_t pair;          // its place among the pairs
    Eigen::Vector3d middle_b;  // where it supposes the middle of b's points
  };

  struct CellPromise {
    std::size_t cell;
    double most;  // no motion in it is supported by more
  };

  const Eigen::Isometry3d& pose(std::size_t scan) const { return *component_.T_reference_scan[scan]; }
  Eigen::Isometry3d motion_by(const Hypothesis& h) const;
  // Whether `h` is of the place that `motion` takes the part to.
  bool is_at(const Hypothesis& h, const Eigen::Isometry3d& motion) const;
  bool is_elsewhere(const Hypothesis& h) const;
  // Those of pairs that support the part where it is.
  std::vector<bool> scans_that_hold() const;
  MotionCells cells(const std::vector<Eigen::Isometry3d>& motions) const;
  // Those whose motions may be supported by more than `least`, the most promising first.
  std::vector<CellPromise> promises(const MotionCells& cells, double least) const;
  // Whether the middle of b's points lies where the hypothesis has it, nearly: tells most that disagree at little cost.
  bool may_agree(const Hypothesis& h, const Eigen::Isometry3d& motion, const Eigen::Isometry3d& back) const;
  SupportAcross support_of(const Pair& p, const Eigen::Isometry3d& motion) const;
  // Of the pairs that these hypotheses, ascending, belong to.
  double support(const Eigen::Isometry3d& motion, const std::vector<std::size_t>& may_agree) const;
  double most_support(const std::vector<std::size_t>& may_agree) const;

  const PairGraph& graph_;
  const Component& component_;
  std::vector<Pair> pairs_;
  std::vector<Hypothesis> hypotheses_;  // in the order of the pairs
  double taught_by_others_;  // the set's constant without the pairs across: at a twin they teach what is wrong
};

}  // namespace tcm_icp
