#pragma once
// What the adjustment to a survey frame found out, for the report.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "tcm_icp/survey/survey.hpp"

namespace tcm_icp {

enum class PointStatus {
  kUsed,
  kBlunder,        ///< contradicts the others: left out of the adjustment
  kCheck,          ///< compared only
  kNotRegistered,  ///< its scan has no pose in the survey frame
};

/// "used", "blunder", "check", "not registered".
const char* to_string(PointStatus status);

struct PointResidual {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  ControlPoint point;
  PointStatus status = PointStatus::kNotRegistered;
  /// [m] computed less given, along the axes of the survey frame, and the standard deviations it should have by what
  /// was stated; NaN where not registered.
  Eigen::Vector3d residual_m = Eigen::Vector3d::Constant(kUnknown);
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Constant(kUnknown);
  /// Of the observation: how much of it the others check, 0 to 3 (its three coordinates); 0 where it was not used.
  double redundancy = 0;
  /// Squared normalised residual, chi squared with three degrees of freedom where all is right; NaN where nothing
  /// checks the point.
  double test = kUnknown;
};

/// Of one component.
struct SurveyRecord {
  bool has_frame = false;  ///< poses are in the survey frame, not in that of the reference scan
  std::string defined_by;  ///< "control points", "positions of scanners", "fixed scans", joined by " and "
  std::string crs;         ///< of that frame; empty: not known
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m] of the local frame uncertainties are in
  int num_rotations = 0;                             ///< 0..3: directions of rotation that the observations determine
  int degrees_of_freedom = 0;                        ///< redundant observations
  double variance_factor =
      PointResidual::kUnknown;        ///< 1 expected: of all that was used, by what was stated; NaN: none redundant
  double largest_change_m = 0;        ///< [m] by which a scan's place among the others was changed, at most
  std::vector<PointResidual> points;  ///< in the order of Survey::points
  std::vector<std::string> remarks;   ///< sentences for a person
};

}  // namespace tcm_icp
