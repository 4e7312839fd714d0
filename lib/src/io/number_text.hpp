#pragma once
// Numbers as files have them, whatever the locale.

#include <cstddef>
#include <string>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// The shortest decimal number that reads as this one.
std::string shortest_digits(double value);
void append_shortest(double value, std::string& text);

/// The same of a value in memory, by its own type: 0.1 as a float is 0.1.
void append_shortest(const std::byte* bytes, ScalarType type, std::string& text);

/// 17 significant digits.
std::string digits17(double value);

}  // namespace tcm_icp
