#pragma once
// Numbers as files have them, whatever the locale.

#include <string>

namespace tcm_icp {

/// The shortest decimal number that reads as this one.
std::string shortest_digits(double value);

/// 17 significant digits.
std::string digits17(double value);

}  // namespace tcm_icp
