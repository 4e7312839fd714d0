#pragma once
// Gently uneven ground.

#include <Eigen/Core>
#include <array>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// A slope of up to 1.5 % and three waves, 12 to 45 m long and 0.4 % of that high. Without a preferred direction, so
/// that the ground itself says a little about where a scan was taken.
class Ground {
 public:
  explicit Ground(Rng& rng);

  double height_m(const Eigen::Vector2d& at) const;

  /// The point of the ground above or below a place on the map.
  Eigen::Vector3d lift(const Eigen::Vector2d& at) const { return {at.x(), at.y(), height_m(at)}; }

  /// Adds the square that reaches `reach_m` from the middle along x and y, in cells of a metre.
  void add_to(TriangleMesh& mesh, double reach_m) const;

  /// Adds what lies within about `reach_m` of the points of a path, in cells of a metre.
  void add_along(TriangleMesh& mesh, const Points& path, double reach_m) const;

 private:
  struct Wave {
    Eigen::Vector2d number = Eigen::Vector2d::Zero();  ///< [rad/m]
    double phase_rad = 0;
    double height_m = 0;
  };
  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();
  std::array<Wave, 3> waves_;
};

}  // namespace tcm_icp
