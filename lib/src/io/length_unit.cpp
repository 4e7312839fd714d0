#include "tcm_icp/io/length_unit.hpp"

namespace tcm_icp {

double metres_in(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      return 0.001;
    case LengthUnit::kFoot:
      return 0.3048;
    case LengthUnit::kUsFoot:
      return 1200.0 / 3937.0;
    default:
      return 1;
  }
}

std::string name_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      return "mm";
    case LengthUnit::kFoot:
      return "ft";
    case LengthUnit::kUsFoot:
      return "us-ft";
    default:
      return "m";
  }
}

std::optional<LengthUnit> unit_from_name(std::string_view name) {
  for (const LengthUnit unit : {LengthUnit::kMetre, LengthUnit::kMillimetre, LengthUnit::kFoot, LengthUnit::kUsFoot}) {
    if (name == name_of(unit)) return unit;
  }
  return std::nullopt;
}

}  // namespace tcm_icp
