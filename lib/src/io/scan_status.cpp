#include "scan_status.hpp"

#include <algorithm>
#include <array>

namespace tcm_icp {
namespace {

// In the order of ScanStatus.
constexpr std::array<std::string_view, 3> kNames = {"reference", "registered", "unregistered"};

}  // namespace

std::string name_of(ScanStatus status) { return std::string(kNames.at(static_cast<std::size_t>(status))); }

std::optional<ScanStatus> status_from_name(std::string_view name) {
  const auto at = std::find(kNames.begin(), kNames.end(), name);
  if (at == kNames.end()) return std::nullopt;
  return static_cast<ScanStatus>(at - kNames.begin());
}

}  // namespace tcm_icp
