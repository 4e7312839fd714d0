#pragma once
// Land that falls to a lake along a winding shore.

#include <Eigen/Core>

#include "simulation/ground.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// The shore runs along x, the lake lies at smaller y, its surface at z = 0.
class Shore {
 public:
  explicit Shore(Rng& rng);

  double shore_y_m(double x) const;
  double height_m(const Eigen::Vector2d& at) const;
  Eigen::Vector3d lift(const Eigen::Vector2d& at) const { return {at.x(), at.y(), height_m(at)}; }

  /// The place `inland_m` from the water at x.
  Eigen::Vector2d inland(double x, double inland_m) const { return {x, shore_y_m(x) + inland_m}; }

  /// Land and water from `begin_m` to `end_m` along x, in cells of a metre.
  void add_to(TriangleMesh& mesh, double begin_m, double end_m) const;

 private:
  Ground relief_;
  Eigen::Vector2d phase_rad_, height_m_, length_m_;  ///< of the two waves of the shore line
};

}  // namespace tcm_icp
