#pragma once
// What a joint adjustment looks at: matches between many scans, and how a residual answers to a step of either scan.

#include <cstddef>
#include <vector>

#include "tcm_icp/registration/correspondences.hpp"
#include "tcm_icp/registration/refinement.hpp"

namespace tcm_icp {

/// Matches of points of scan `source` in scan `target`, points and normals moved into the frame common to all scans.
struct JointLink {
  std::size_t target = 0, source = 0;
  Correspondences matches;
};

/// Distance [m] of the source point from the plane at the target point, with the normal's sign, times the match's
/// precision: all residuals have one standard deviation where precisions are right.
inline double residual_m(const Correspondence& match) {
  return match.precision * match.normal.dot(match.source - match.target);
}

/// Derivative of the residual by a step of the source scan about `frame`; a step of the target scan about a frame of
/// its own has the opposite sign. All six entries are without unit: the rotation is measured by its arc at the radius.
inline Twist residual_gradient(const Correspondence& match, const TwistFrame& frame) {
  Twist gradient;
  gradient << (match.source - frame.centre).cross(match.normal) / frame.radius_m, match.normal;
  return match.precision * gradient;
}

/// Absolute residuals [m] of all matches, in order.
std::vector<double> absolute_residuals_m(const std::vector<JointLink>& links);

/// Standard deviation [m] of the residuals, by their median absolute value; 0 where there are none.
double robust_noise_m(const std::vector<JointLink>& links);

}  // namespace tcm_icp
