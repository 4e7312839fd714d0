#pragma once
// Registration by linear programs: nearest neighbours, one L1 fit by the simplex method, and again.

#include <functional>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/registration/correspondences.hpp"
#include "tcm_icp/registration/l1_fit.hpp"
#include "tcm_icp/registration/registration_result.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

/// What one step minimises over its matches.
enum class LpFormulation {
  kPointToPlane,  ///< sum |n . (p' - q)| in the 6 parameters of a twist, by the simplex
  kPointToPoint,  ///< sum |p' - q|_1 in the same, by the simplex
  kEntries,       ///< sum |p' - q|_1 in the 12 entries of R and T, by the simplex, and a projection (the paper's)
  kLeastSquares,  ///< sum (n . (p' - q))^2 in the 6 parameters, without the simplex
};

/// Takes out of the matches of a pose those that are none.
using MatchSelection = std::function<void(const Eigen::Isometry3d& T_target_source, Correspondences& matches)>;

struct LpRegistrationOptions {
  LpFormulation formulation = LpFormulation::kPointToPlane;
  double initial_gate_m = 0;             ///< [m] > 0; correspondences may be this far apart at first
  double final_gate_m = 0;               ///< [m] > 0, <= initial_gate_m; and this far at last
  double gate_shrink = 0.75;             ///< 0 < shrink < 1; factor on the gate from one iteration to the next
  double initial_normal_angle_deg = 60;  ///< [deg] normals may differ by this much at first
  double final_normal_angle_deg = 30;    ///< [deg] and by this much at last
  int max_iterations = 60;               ///< >= 1
  /// Stop when a step moves the points less than this share of the final gate (rms), or leads as near to a pose that
  /// one before led to. The gate is two voxels of eight times the noise or more: about what noise leaves open in a fit.
  double convergence_share = 0.01;
  int min_correspondences = 12;  ///< >= 6
  L1FitOptions lp;
  void validate() const;  ///< throws InvalidOptions naming field, value and bound
};

/// One L1 point-to-plane step: the twist about `centre` that minimises sum |n . (p + w x (p - centre) + t - q)|, 6
/// unknowns, solved exactly through its dual linear program. Rotations are scaled by the matches' RMS radius.
/// @param iterations  what the step did is added to its LP figures
Termination lp_point_to_plane_step(const Correspondences& matches, const L1FitOptions& options,
                                   Eigen::Isometry3d& T_target_source, LpFigures& figures, double& step_m);

/// A step of any formulation, for comparison; kPointToPlane is the function above.
/// @note The L1 norm of a vector depends on the axes: kPointToPoint and kEntries are not the same in a turned frame.
Termination registration_step(LpFormulation formulation, const Correspondences& matches, const L1FitOptions& options,
                              Eigen::Isometry3d& T_target_source, LpFigures& figures, double& step_m);

/// Registers `source` to `target` from T_init: correspondences within a gate on distance and normal that shrinks from
/// initial to final, an L1 step on each set, until steps are small at the final gate.
/// The target's pyramid level follows the gate, so the first steps are cheap and blind to detail.
/// @param select  takes out matches that are none, at the pose they were found at; none: all are used
RegistrationResult register_lp(const Cloud& source, const ScanPyramid& target, const Eigen::Isometry3d& T_init,
                               const LpRegistrationOptions& options, const MatchSelection& select = {});

}  // namespace tcm_icp
