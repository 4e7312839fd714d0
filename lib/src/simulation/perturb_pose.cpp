#include "tcm_icp/simulation/perturb_pose.hpp"

#include <cmath>
#include <string>

#include "simulation/draw.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {

void PosePerturbation::validate() const {
  if (!(max_rotation_deg >= 0 && max_rotation_deg <= 180)) {
    throw InvalidOptions("initial guess: max_rotation_deg = " + std::to_string(max_rotation_deg) + "; needs 0..180");
  }
  if (!(max_shift_m >= 0 && std::isfinite(max_shift_m))) {
    throw InvalidOptions("initial guess: max_shift_m = " + std::to_string(max_shift_m) + "; needs >= 0");
  }
}

Eigen::Isometry3d perturb_pose(const Eigen::Isometry3d& T_world_scan, const Eigen::Vector3d& centre_world,
                               const PosePerturbation& options, Rng& rng) {
  options.validate();
  const double angle_rad = radians(options.max_rotation_deg) * uniform(rng, 0.6, 1);
  const Eigen::Vector3d axis = uniform_direction(rng);
  const double shift_m = options.max_shift_m * uniform(rng, 0.6, 1);
  const Eigen::Vector3d direction = uniform_direction(rng);
  Twist twist;
  twist << angle_rad * axis, shift_m * direction;
  return isometry_about(centre_world, twist) * T_world_scan;
}

}  // namespace tcm_icp
