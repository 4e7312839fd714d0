#include "tcm_icp/visibility/sight.hpp"

namespace tcm_icp {

int Sight::side(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  bool towards = false, away = false;
  for (const auto& place : places) {
    const double height_m = normal.dot(place - point);
    towards = towards || height_m > 0;
    away = away || height_m < 0;
  }
  return towards == away ? 0 : towards ? 1 : -1;
}

Sight make_sight(const std::optional<Viewpoint>& viewpoint, const Points& fine, const Cloud& surfaces) {
  Sight sight;
  if (!viewpoint || !viewpoint->roughly_determined()) return sight;
  sight.places = {viewpoint->place};
  sight.places.insert(sight.places.end(), viewpoint->alternatives.begin(), viewpoint->alternatives.end());
  if (viewpoint->determined()) {
    for (const auto& place : sight.places) sight.images.emplace_back(place, fine);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    sight.facing.push_back(sight.side(surfaces.points[i], surfaces.normals[i]) * surfaces.normals[i]);
  }
  return sight;
}

}  // namespace tcm_icp
