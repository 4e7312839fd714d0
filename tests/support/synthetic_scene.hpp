#pragma once
// Scans of made-up places with known poses: the truth that registration is measured against.

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp::testing {

enum class SyntheticShape {
  kYard,            ///< 24 x 18 m: ground, four walls not at right angles, boxes at odd headings, a roof, two tubes
  kRubble,          ///< 60 slabs of all directions; shares nothing with the yard
  kParallelPlanes,  ///< ground and ceiling: nothing holds a scan along x, y or about z
};

struct SyntheticSceneOptions {
  SyntheticShape shape = SyntheticShape::kYard;
  std::size_t num_scans = 2;           ///< >= 1; scanners stand on an ellipse about the middle
  std::size_t points_per_scan = 3000;  ///< >= 1; no point is in two scans
  double range_m = 14;                 ///< [m] horizontal reach of a scanner: the less, the less overlap
  double noise_m = 0;                  ///< [m] standard deviation along the surface normal
  double outlier_share = 0;            ///< 0..1; share of the points that is anywhere in the scanner's reach
};

struct SyntheticScene {
  std::vector<Cloud> scans;                     ///< each in its own frame, with the surfaces' exact normals
  std::vector<Eigen::Isometry3d> T_world_scan;  ///< rotations are uniform over SO(3)
  double spacing_m = 0;                         ///< [m] edge of the square that holds one point of a scan, on average

  Eigen::Isometry3d T_target_source(std::size_t target, std::size_t source) const {
    return T_world_scan[target].inverse() * T_world_scan[source];
  }
};

/// Surfaces are seen through: a scan holds what is in reach, each surface in proportion to its area.
SyntheticScene synthetic_scene(const SyntheticSceneOptions& options, Rng& rng);

/// A rotation uniform over SO(3), and a translation of up to `reach_m` an axis.
Eigen::Isometry3d random_pose(double reach_m, Rng& rng);

/// T with a further rotation by `angle_rad` about a random axis through the moved points' middle, and a shift of
/// `shift_m`.
Eigen::Isometry3d perturbed(const Eigen::Isometry3d& T, const Points& points, double angle_rad, double shift_m,
                            Rng& rng);

/// Root mean square [m] of how far apart the two poses put the points.
double pose_rmse_m(const Eigen::Isometry3d& expected, const Eigen::Isometry3d& actual, const Points& points);

/// The same cloud in other units.
Cloud scaled_cloud(Cloud cloud, double factor);

/// The same pose in other units.
Eigen::Isometry3d scaled_pose(Eigen::Isometry3d T, double factor);

}  // namespace tcm_icp::testing
