#pragma once
// Units that scans' coordinates may be in. Everything is worked out in metres.

#include <optional>
#include <string>
#include <string_view>

namespace tcm_icp {

/// A unit of length.
enum class LengthUnit {
  kMetre,       ///< m
  kMillimetre,  ///< mm
  kFoot,        ///< ft, 0.3048 m
  kUsFoot       ///< us-ft, 1200/3937 m
};

/// Metres in one of them: exact definitions, the US survey foot as 1200/3937.
double metres_in(LengthUnit unit);

/// m, mm, ft, us-ft.
std::string name_of(LengthUnit unit);

/// nullopt where there is no unit of that name.
std::optional<LengthUnit> unit_from_name(std::string_view name);

}  // namespace tcm_icp
