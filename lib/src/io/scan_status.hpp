#pragma once
// The status of a scan by what files call it.

#include <optional>
#include <string_view>

#include "tcm_icp/core/verdict.hpp"

namespace tcm_icp {

/// Of to_string()'s names; nothing where no status is called that.
std::optional<ScanStatus> status_from_name(std::string_view name);

}  // namespace tcm_icp
