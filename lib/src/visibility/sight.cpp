#include "tcm_icp/visibility/sight.hpp"

namespace tcm_icp {
namespace {

// More nearly along the surface, noise turns the normal to either side.
constexpr double kMinSightCosine = 0.1;

int side_from(const Points& places, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  bool towards = false, away = false;
  for (const auto& place : places) {
    const double cosine = normal.dot((place - point).normalized());
    towards = towards || cosine > -kMinSightCosine;
    away = away || cosine < kMinSightCosine;
  }
  return towards == away ? 0 : towards ? 1 : -1;
}

}  // namespace

int Sight::side(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  return side_from(places, point, normal);
}

int Sight::guessed_side(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  return side_from(knows_sides() ? places : guessed_places, point, normal);
}

Sight make_sight(const std::optional<Viewpoint>& viewpoint, const Points& fine, const Cloud& surfaces) {
  Sight sight;
  if (!viewpoint) return sight;
  sight.swept = viewpoint->determined() && viewpoint->evidence == ViewpointEvidence::kScanLines;
  Points& places = viewpoint->roughly_determined() ? sight.places : sight.guessed_places;
  places = {viewpoint->place};
  places.insert(places.end(), viewpoint->alternatives.begin(), viewpoint->alternatives.end());
  if (!sight.knows_sides()) return sight;
  if (viewpoint->determined()) {
    for (const auto& place : sight.places) sight.images.emplace_back(place, fine);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    sight.facing.push_back(sight.side(surfaces.points[i], surfaces.normals[i]) * surfaces.normals[i]);
  }
  return sight;
}

}  // namespace tcm_icp
