#pragma once
// First hit of a ray on a mesh (CGAL's AABB tree, hidden).

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

struct RayHit {
  double range_m = 0;                                 ///< [m] from the ray's origin
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, against the ray
  double reflectivity = 0;                            ///< of the surface that was hit
};

/// Built in the constructor, so every query is const and thread-safe. Cost O(N log N) to build, O(log N) expected a
/// query.
class RayCaster {
 public:
  /// Triangles without area are left out: they reflect nothing.
  /// @throws InvalidInput  if a corner is not finite, or no triangle has an area
  explicit RayCaster(const TriangleMesh& mesh);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// Nearest surface along the ray; nothing where it meets none within `max_range_m`. `direction` is a unit vector.
  std::optional<RayHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  double max_range_m) const;

  /// Distance [m] from a point to the nearest surface.
  double distance_m(const Eigen::Vector3d& point) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
