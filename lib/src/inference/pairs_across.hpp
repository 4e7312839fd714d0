#pragma once
// The evidence between a part of a component, which moves as one, and the rest of it.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "inference/compared_pairs.hpp"

namespace tcm_icp {

/// Keeps references to graph and component, which must outlive it and not change.
class PairsAcross {
 public:
  /// @param moved  members of the component
  PairsAcross(const PairGraph& graph, const Component& component, const std::vector<std::size_t>& moved);

  /// What the pairs say for the part at motion * T, T its poses in the component, less log_poses.
  /// Cost: the hypotheses of the pairs.
  double support(const Eigen::Isometry3d& motion) const;

  struct Elsewhere {
    double support = 0;
    std::optional<Eigen::Isometry3d> motion;  ///< none where no hypothesis leads elsewhere
  };
  /// The best supported motion that a hypothesis leads to by which its scan leaves its pose.
  /// Cost: each motion asks the hypotheses that may agree with it, found in a tree.
  Elsewhere best_elsewhere() const;

  /// No less than the support of any motion that leaves no pair at its pose. Cost: the hypotheses of the pairs.
  double most_elsewhere() const;

 private:
  struct Pair {
    const ComparedPair* pair;
    bool moves_b;
    double most_support;       // of any of its hypotheses
    Eigen::Vector3d middle_b;  // of b's points, in the reference's frame
  };
  // By a hypothesis, which is a motion of the part, with the other scan of its pair at its pose.
  struct Hypothesis {
    const PoseHypothesis* hypothesis;
    std::size_t pair;          // its place among the pairs
    Eigen::Vector3d middle_b;  // where it supposes the middle of b's points
  };

  const Eigen::Isometry3d& pose(std::size_t scan) const { return *component_.T_reference_scan[scan]; }
  Eigen::Isometry3d motion_by(const Hypothesis& h) const;
  bool is_elsewhere(const Hypothesis& h) const;
  double support_of(const Pair& p, const Eigen::Isometry3d& motion) const;
  // Of the hypotheses that `indices` names, ascending.
  double support(const Eigen::Isometry3d& motion, const std::vector<std::size_t>& indices) const;
  double most_support(const std::vector<std::size_t>& indices) const;

  const PairGraph& graph_;
  const Component& component_;
  std::vector<Pair> pairs_;
  std::vector<Hypothesis> hypotheses_;  // in the order of the pairs
};

}  // namespace tcm_icp
