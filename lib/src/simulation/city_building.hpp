#pragma once
// Buildings of a street front, side by side or alone.

#include <Eigen/Geometry>

#include "simulation/facade.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

enum class RoofKind { kFlat, kGabled, kMansard };

struct CityBuilding {
  Eigen::Vector2d half_size_m{6, 5};  ///< x along the street
  int num_storeys = 3;
  FacadeStyle facade;
  RoofKind roof = RoofKind::kFlat;
  double roof_rise_m = 3;
};

/// Of this size, and with as many storeys, but else any.
CityBuilding random_city_building(const Eigen::Vector2d& half_size_m, int num_storeys, Rng& rng);

/// The front faces -y; the origin is on the ground in the middle.
void add_city_building(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_building, const CityBuilding& building,
                       Rng& rng);

}  // namespace tcm_icp
