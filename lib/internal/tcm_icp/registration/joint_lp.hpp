#pragma once
// One linear program for the poses of all scans at once: least absolute distances to planes over a whole graph of
// links.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "tcm_icp/registration/joint_links.hpp"
#include "tcm_icp/registration/linear_program.hpp"

namespace tcm_icp {

struct JointLpOptions {
  LpOptions lp;
  double tie_breaking = 1e-6;  ///< in [0, 1); noise on the residuals, in units of their median, so that no two tie
  std::uint64_t seed = 42;     ///< of that noise
  /// in (0, 1); a step of a scan must save more than this share of what it would cost if each of the scan's matches
  /// grew by it. It holds still what the matches do not determine, and nothing else.
  double hold = 1e-3;

  void validate() const;  ///< throws InvalidOptions
};

struct JointLpResult {
  LpStatus status = LpStatus::kNotRun;
  std::vector<Twist> steps_m;  ///< one a scan, for its TwistFrame; zero for the fixed one and for scans without links
  double initial_objective_m = std::numeric_limits<double>::quiet_NaN();  ///< sum of absolute residuals before
  double objective_m = std::numeric_limits<double>::quiet_NaN();          ///< and after the steps, linearised
  double duality_gap = std::numeric_limits<double>::quiet_NaN();          ///< see LpCertificate
  std::vector<double> link_medians_m;  ///< median absolute residual of each link after the steps; NaN without matches
  std::size_t num_matches = 0;
  int pivots = 0;
  double seconds = 0;  ///< [s] wall time

  bool optimal() const { return status == LpStatus::kOptimal; }
};

/// Minimises sum |r_i + g_i' x_source - h_i' x_target| over the steps x of all scans but `fixed`, through the dual: six
/// equations a scan, one boxed variable a match with at most twelve coefficients, and one a coordinate for `hold`.
/// Steps are lengths about each scan's frame, so that the equations have one unit.
///
/// @param frames  of each scan, at its present pose
/// @param fixed   < frames.size(); the scan that does not move
/// @throws InvalidInput  if a link names a scan there is none of, or itself, or a number is not finite
/// @note Without matches, or where all residuals are 0, the steps are 0 and no program is solved.
/// Cost: docs/decisions/0001 and 0010. Thread-safe.
JointLpResult solve_joint_lp(const std::vector<TwistFrame>& frames, std::size_t fixed,
                             const std::vector<JointLink>& links, const JointLpOptions& options = {});

/// Links whose median residual stands out from those of all links: above `noise_m`, and above their median by more than
/// three robust standard deviations. Fewer than four links say nothing about one another: then none does. Ascending.
std::vector<std::size_t> outlying_links(const std::vector<double>& link_medians_m, double noise_m);

}  // namespace tcm_icp
