#pragma once
// Evidence that a pose is right, from points its fit did not use.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

/// What the held-out points of a cloud say about its pose against a target.
struct AlignmentEvidence {
  std::size_t num_points = 0;  ///< held-out points looked up
  double overlap = 0;          ///< share of them with a target point within the gate
  double inlier_share = 0;     ///< share of the overlapping ones within the tolerance of their plane, normals agreeing
  double median_residual_m = 0;  ///< [m] distance to the plane, overlapping points
  double tolerance_m = 0;        ///< [m] what counted as within the noise
  /// How much of the consensus is left when the pose slides along each of its six principal directions, weakest (most
  /// is left) first: 1 where the sliding costs nothing.
  std::array<double, 6> left_after_slide{};
  double slide_m = 0;  ///< [m] rms length of these slides
  /// The same of the weakest slide, of the points alone whose surfaces it crosses: walls along a corridor agree
  /// wherever a scan slides to, and outnumber the door frames that tell. 1 where none agrees.
  double left_across = 1;
  std::size_t num_across = 0;  ///< of these points, those that agree
  /// Share of all held-out points that agree.
  double consensus() const { return overlap * inlier_share; }
};

struct VerificationOptions {
  double gate_m = 0;                 ///< [m] > 0; a target point this near makes a point overlap
  double tolerance_m = 0;            ///< [m] > 0; distance to the plane within the noise
  double slide_m = 0;                ///< [m] > 0; length of the trial slides
  double max_normal_angle_deg = 30;  ///< [deg]
  bool with_slides = true;           ///< without, left_after_slide stays at 1, and a point costs one query
  void validate() const;             ///< throws InvalidOptions
};

/// Principal directions are those of the point-to-plane information matrix (Gelfand et al., 2003): the weakest is the
/// direction the scan can slide along most freely. Cost: 13 to 16 nearest-neighbour queries a point.
AlignmentEvidence verify_alignment(const Cloud& held_out, const PyramidLevel& target,
                                   const Eigen::Isometry3d& T_target_source, const VerificationOptions& options);

}  // namespace tcm_icp
