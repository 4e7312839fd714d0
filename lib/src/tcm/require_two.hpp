#pragma once
// What measures of two clouds ask of each.

#include <string>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

/// The points. @throws InvalidInput  fewer than two, by which `measure` is not defined
inline const Points& require_two(const Points& points, const std::string& measure) {
  if (points.size() < 2) {
    throw InvalidInput(measure + " needs clouds of at least 2 points, not " + std::to_string(points.size()));
  }
  return points;
}

}  // namespace tcm_icp
