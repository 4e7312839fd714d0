#pragma once
// One scan of a result that is there already, in the common frame.

#include <filesystem>
#include <optional>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/io/output_options.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// Writes scans/NAME.EXT into the folder of a result, as write_result() does where each scan is wanted: whole or not at
/// all. Which points are outliers is in the work folder, or found out again.
/// @param poses  of the result
/// @return       the file; nothing where the scan is unregistered
/// @throws InputError      the scan cannot be read
/// @throws InvalidOptions  the scan is not in the result, or its name could be that of several
/// @throws OutputError, Cancelled
std::optional<std::filesystem::path> write_scan(const StepStore& steps, const std::filesystem::path& folder,
                                                const std::filesystem::path& scan, const PoseFile& poses,
                                                const PipelineOptions& options, const OutputOptions& clouds,
                                                const RunContext& context);

}  // namespace tcm_icp
