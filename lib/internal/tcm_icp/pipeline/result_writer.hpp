#pragma once
// The files of a result: poses.json, poses/, transforms/, registered.ply (or .las, .pcd, .xyz, .e57, .ptx), scans/,
// report.json, report.html.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/io/output_options.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/pipeline/report_options.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// What the report says of the run beside its result.
struct RunDescription {
  std::string version;
  std::string command_line;
  std::string initial_poses;  ///< file of the initial guess; empty: none was given
  std::string started;        ///< date and time, ISO 8601; empty: not told
  ReportOptions report = {};
};

/// The report as JSON text (docs/formats.md). Numbers that are not known are null; bytes that are not UTF-8, in names
/// of files, become U+FFFD.
std::string report_json(const PipelineResult& result, const PipelineOptions& options, const RunContext& context,
                        const RunDescription& description);

/// @throws OutputError  where `folder` exists and `overwrite` is not set, or its parent cannot be written to. To be
/// called before the work starts.
void check_output_folder(const std::filesystem::path& folder, bool overwrite);

/// Writes all files into a temporary folder beside `folder` and renames it: a failed run leaves nothing. The raw points
/// stream by a second time: outliers are left out, attributes kept. The time it takes is added to result.stages.
/// @param steps  has the check sums of files that it knows; nullptr: files are read for them
/// @throws InputError, OutputError, Cancelled
void write_result(const std::filesystem::path& folder, bool overwrite, std::span<const ScanInput> inputs,
                  PipelineResult& result, const PipelineOptions& options, const OutputOptions& clouds,
                  const RunContext& context, const RunDescription& description, const StepStore* steps = nullptr);

/// The same of scans in files.
void write_result(const std::filesystem::path& folder, bool overwrite, const std::vector<std::filesystem::path>& paths,
                  PipelineResult& result, const PipelineOptions& options, const OutputOptions& clouds,
                  const RunContext& context, const RunDescription& description, const StepStore* steps = nullptr);

}  // namespace tcm_icp
