#include "tcm_icp/simulation/scene.hpp"

#include <cmath>

namespace tcm_icp {

PathPoint along_path(const Points& path, double distance_m) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Eigen::Vector3d step = path[i + 1] - path[i];
    const double length = step.norm();
    const bool last = i + 2 == path.size();
    if (distance_m > length && !last) {
      distance_m -= length;
      continue;
    }
    const double share = std::clamp(distance_m / length, 0.0, 1.0);
    return {path[i] + share * step, std::atan2(step.y(), step.x())};
  }
  return {path.front(), 0};
}

double path_length_m(const Points& path) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) sum += (path[i + 1] - path[i]).norm();
  return sum;
}

}  // namespace tcm_icp
