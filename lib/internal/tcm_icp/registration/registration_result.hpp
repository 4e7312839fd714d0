#pragma once
// What a registration step did, and whether its pose can be used.

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <string_view>

namespace tcm_icp {

enum class Termination {
  kNotRun,
  kConverged,
  kMaxIterations,
  kStopped,
  kTooFewCorrespondences,
  kLpInfeasible,
  kLpFailed,
};

std::string_view to_string(Termination termination);

/// The certificate of the last linear program a step solved, and the effort of all of them.
struct LpFigures {
  int num_programs = 0;
  long long num_pivots = 0;                                                ///< over all programs
  double objective = std::numeric_limits<double>::quiet_NaN();             ///< [m] of the last program
  double relative_duality_gap = std::numeric_limits<double>::quiet_NaN();  ///< largest over all programs
  double seconds = 0;                                                      ///< in the solver, over all programs

  LpFigures& operator+=(const LpFigures& later);
};

struct RegistrationResult {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  Termination termination = Termination::kNotRun;                       ///< a forgotten call cannot pass for a result
  int num_iterations = 0;                                               ///< completed iterations
  std::size_t num_correspondences = 0;                                  ///< used in the last iteration
  double median_residual_m = std::numeric_limits<double>::quiet_NaN();  ///< [m] |distance to plane|, last iteration
  LpFigures lp;

  bool usable() const { return termination == Termination::kConverged || termination == Termination::kMaxIterations; }
};

}  // namespace tcm_icp
