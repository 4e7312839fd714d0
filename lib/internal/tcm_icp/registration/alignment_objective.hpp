#pragma once
// How badly a cloud fits a target under a pose: one bounded number, with its gradient.

#include <Eigen/Geometry>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

/// Mean of rho(r) = r^2 / (r^2 + scale^2) (Geman and McClure, 1985) over the source points, r the distance to the plane
/// at the nearest target point [m]; a point without a neighbour within the gate, or whose neighbour faces another way,
/// costs 1. Keeps references: source and target must outlive it. Thread-safe.
class AlignmentObjective {
 public:
  /// @param scale_m  [m] > 0; a residual of this size costs one half
  /// @param gate_m   [m] > 0; neighbours farther away do not count
  AlignmentObjective(const Cloud& source, const PyramidLevel& target, double scale_m, double gate_m);

  /// 0 (every point on its plane) to 1 (no point near anything). One nearest-neighbour query a point.
  double cost(const Eigen::Isometry3d& T_target_source) const;

  /// The cost, and its derivative by a twist (rotation vector about `centre` [1/rad], translation [1/m]) applied after
  /// the pose, with the neighbours held fixed.
  double cost_and_gradient(const Eigen::Isometry3d& T_target_source, const Eigen::Vector3d& centre,
                           Twist& gradient) const;

 private:
  template <typename Visit>
  double sum(const Eigen::Isometry3d& T_target_source, Visit visit) const;

  const Cloud& source_;
  const PyramidLevel& target_;
  double squared_scale_m2_;
  double gate_m_;
};

}  // namespace tcm_icp
