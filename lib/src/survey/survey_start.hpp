#pragma once
// A first survey frame that the adjustment can start from.

#include <Eigen/Geometry>

#include "survey/survey_adjustment.hpp"

namespace tcm_icp {

/// T_survey_local by the first known pose, or by the points, that are `used`: the rotation that fits them best (Kabsch,
/// 1976), about the vertical alone where scans are level. Points on a line turn the frame no more than the line asks
/// for, a single one not at all.
Eigen::Isometry3d start_of_survey(const ScanNetwork& network, const SurveyObservations& observations,
                                  const UsedObservations& used);

}  // namespace tcm_icp
