#include "adjustment/bend_evidence.hpp"

#include "tcm_icp/core/morton_code.hpp"
#include "tcm_icp/registration/pose_covariance.hpp"

namespace tcm_icp {

std::uint64_t cube_of(const Eigen::Vector3d& point, const Eigen::Vector3d& centre, double edge_m) {
  constexpr double kMiddle = 1 << (kMortonBits - 1);
  std::uint64_t cube = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::floor((point[axis] - centre[axis]) / edge_m) + kMiddle;
    cube |= morton_spread(static_cast<std::uint64_t>(std::clamp(place, 0.0, 2 * kMiddle - 1))) << axis;
  }
  return cube;
}

// As for the covariance of poses.
std::size_t least_cubes() { return PoseCovarianceOptions().min_blocks_of_scan; }

}  // namespace tcm_icp
