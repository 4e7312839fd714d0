#pragma once
// What the columns of a text file are, by the words people put above them.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tcm_icp {

/// The columns of x, y and z: those of these names, else east, north and height in one of their spellings ("Easting",
/// "N", "Elevation"); any case, units in brackets are passed over. nullopt where one of them is missing.
std::optional<std::array<std::size_t, 3>> find_axes(const std::vector<std::string_view>& names);

/// "red", "green" or "blue" for "R", "Green", ...; empty for all else.
std::string colour_of(std::string_view name);

/// Names of the columns behind x y z in a PTS file without a header; empty where their number is not usual there.
std::vector<std::string> pts_names(std::size_t num_columns);

/// Splits at blanks: true where that gives three fields or more, and each comma stands between two digits, at most one
/// a field: 1,5 2,5 3,5.
bool has_decimal_commas(std::string_view line);

/// True where commas seem to stand between columns and within numbers: 1,05,2,5,3,25. An even number of columns, six or
/// more, all of digits, and every second one, but none of the others, somewhere begins with a 0 before other digits.
bool has_commas_for_both(std::string_view text);

}  // namespace tcm_icp
