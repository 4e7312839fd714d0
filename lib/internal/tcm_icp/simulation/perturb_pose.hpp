#pragma once
// Rough initial guesses made from true poses.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

struct PosePerturbation {
  double max_rotation_deg = 5;  ///< [deg] 0..180; each pose is off by 0.6 to 1 times this, about a random axis
  double max_shift_m = 0.5;     ///< [m] >= 0; and by 0.6 to 1 times this, in a random direction
  void validate() const;        ///< throws InvalidOptions
};

/// T_world_scan after a random turn about `centre_world` (so that the shift is what its name says, wherever the origin
/// lies) and a random shift.
/// @throws InvalidOptions
Eigen::Isometry3d perturb_pose(const Eigen::Isometry3d& T_world_scan, const Eigen::Vector3d& centre_world,
                               const PosePerturbation& options, Rng& rng);

}  // namespace tcm_icp
