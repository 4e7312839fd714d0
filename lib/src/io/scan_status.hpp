#pragma once
// What files call the status of a scan.

#include <optional>
#include <string>
#include <string_view>

#include "tcm_icp/io/pose_io.hpp"

namespace tcm_icp {

/// "reference", "registered", "unregistered".
std::string name_of(ScanStatus status);

/// Nothing where no status is called that.
std::optional<ScanStatus> status_from_name(std::string_view name);

}  // namespace tcm_icp
