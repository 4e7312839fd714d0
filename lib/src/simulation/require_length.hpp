#pragma once
// The check that options of scenes share.

#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

/// @param field  as "street: length_m"
/// @throws InvalidOptions  where `value` [m] is not within `least` and `most`, or no number
inline void require_length(const std::string& field, double value, int least, int most) {
  if (!(value >= least && value <= most)) {
    throw InvalidOptions(field + " = " + std::to_string(value) + "; needs " + std::to_string(least) + ".." +
                         std::to_string(most));
  }
}

}  // namespace tcm_icp
