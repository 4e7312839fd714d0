#pragma once
// Scalars as bytes, as numbers and as text.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// "float", "uchar", ... as a PLY header writes it.
std::string_view ply_type_name(ScalarType type);

/// Both families of names ("uchar" and "uint8"); nullopt for anything else.
std::optional<ScalarType> parse_ply_type(std::string_view name);

bool is_floating(ScalarType type);

/// True where every finite value of `inner` is exactly a value of `outer`.
bool holds(ScalarType outer, ScalarType inner);

/// True where `value` can be stored: integers take whole numbers within their range, floats take everything.
bool fits(double value, ScalarType type);

/// The value at `bytes`, native byte order, no alignment needed. Exact: a double holds them all.
double load_scalar(const std::byte* bytes, ScalarType type);

/// @pre fits(value, type)
void store_scalar(double value, ScalarType type, std::byte* bytes);

/// Reverses `size` bytes while copying.
void copy_reversed(const std::byte* from, std::size_t size, std::byte* to);

/// A decimal number, whatever the locale; a leading + and every spelling of nan and inf are understood. nullopt where
/// the whole token is not a number, or is beyond the range of double.
std::optional<double> parse_number(std::string_view token);

/// The token for an error message: in quotes, printable, at most 40 characters.
std::string quoted(std::string_view token);

}  // namespace tcm_icp
