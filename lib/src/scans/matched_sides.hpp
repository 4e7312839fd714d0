#pragma once
// Matches of a wall's two faces, which are no matches.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/registration/correspondences.hpp"
#include "tcm_icp/visibility/sight.hpp"

namespace tcm_icp {

/// Drops matches of surfaces that the two scans saw from opposite sides, where both know sides: a thin wall's other
/// face is near, and its normal an axis of the same direction. Few of them, too: along a corridor few matches hold a
/// scan. Cost: the matches.
/// @param matches  in the target's frame, with the source moved by T_target_source
void drop_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_target_source,
                  Correspondences& matches);

/// Of each match whether its surfaces would be such, by the most likely places the two scans were taken from, where
/// these are unsure; none where both know sides, for drop_opposed() is for those. Cost: the matches.
/// @param matches  the same
std::vector<bool> may_be_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_target_source,
                                 const Correspondences& matches);

}  // namespace tcm_icp
