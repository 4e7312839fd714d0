#pragma once
// A line of text and its fields.

#include <string_view>
#include <vector>

namespace tcm_icp {

/// Without the characters `blanks` at its ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t");

/// Splits a line, without copying. ' ' splits at runs of blanks and tabs; any other delimiter splits at each of it and
/// trims, so that an empty field is seen as one; a single delimiter at the end is no field.
void split_fields(std::string_view line, char delimiter, std::vector<std::string_view>& fields);

}  // namespace tcm_icp
