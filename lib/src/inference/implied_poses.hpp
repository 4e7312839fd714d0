#pragma once
// What a configuration says of pairs that no hypothesis of their own speaks for.

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "inference/compared_pairs.hpp"
#include "inference/cuts.hpp"

namespace tcm_icp {

struct ImpliedPose {
  std::size_t a = 0, b = 0;  ///< a < b
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  bool agrees = false;            ///< a hypothesis leads there already, as near as a fit would
  std::size_t configuration = 0;  ///< 0: the component; others: what another place of a scan or part makes of it
};

/// Of every pair of members, its pose in the component; of pairs across a cut whose lead is below `clear_lead`, their
/// pose where the cut's other motion puts its part; and of each member's pairs their pose where a likely hypothesis of
/// another of them puts it that agrees with the component, and that a fit tells apart (a wall's other face). A place is
/// known by what its pairs show there, the other place no less than this one: pairs that no search brought there say as
/// much.
/// @param cuts         weakest_cuts() of the component
/// @param may_overlap  whether scans a and b can overlap at T_a_b; poses of others are left out
std::vector<ImpliedPose> implied_poses(
    const PairGraph& graph, const Component& component, const std::vector<Cut>& cuts, double clear_lead,
    const std::function<bool(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b)>& may_overlap);

}  // namespace tcm_icp
