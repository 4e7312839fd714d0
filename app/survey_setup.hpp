#pragma once
// The options that define a survey frame, as what the library is called with.

#include <filesystem>
#include <vector>

#include "register_options.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/survey/survey.hpp"

namespace tcm_icp::app {

/// @throws InvalidOptions  options that need others, a scan that is none
/// @throws InputError      a file that cannot be read
Survey read_survey(const RegisterOptions& options, const std::vector<std::filesystem::path>& scans);

/// What coordinate system the survey frame has: that of --crs, or else the one that the scans' files name, if it is
/// one. Says so, and where it is not kept.
void settle_coordinate_system(const RegisterOptions& options, const std::vector<std::filesystem::path>& scans,
                              const RunContext& context, Survey& survey);

}  // namespace tcm_icp::app
