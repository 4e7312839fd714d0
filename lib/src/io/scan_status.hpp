#pragma once
// Status and verdict of a scan by what files call them.

#include <optional>
#include <string_view>

#include "tcm_icp/core/verdict.hpp"

namespace tcm_icp {

/// Of to_string()'s names; nothing where nothing is called that.
std::optional<ScanStatus> status_from_name(std::string_view name);
std::optional<Verdict> verdict_from_name(std::string_view name);

}  // namespace tcm_icp
