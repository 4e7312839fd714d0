#pragma once
// Figures in sentences for a person.

#include <string>

namespace tcm_icp {

/// So many significant digits, with an exponent where that is shorter.
std::string figure(double value, int digits = 3);

/// "12 %" for 0.123.
std::string percent(double share);

}  // namespace tcm_icp
