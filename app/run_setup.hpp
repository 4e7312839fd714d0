#pragma once
// From options to what the library is called with; common to the commands that read a set of scans.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "console.hpp"
#include "register_options.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/io/scan_inputs.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp::app {

/// Warns of the files in folders that were left out.
void report_left_out(const ScanInputs& inputs, const RunContext& context);

/// Says which coordinate system the scans are in, where LAS and E57 files name one, and `what` becomes of it; warns
/// where they name different ones.
/// @return  the only one that is named; empty where there is none, or are several
std::string report_coordinate_systems(const std::vector<std::filesystem::path>& scans, const std::string& what,
                                      const RunContext& context);

/// Indices of the scans that `name` stands for on the command line: their name, number, path, or the file they are in.
/// @param option  for the message, as "--fix a.ply"
/// @throws InvalidOptions  none is called that
std::vector<std::size_t> scans_called(const std::string& name, const std::vector<std::filesystem::path>& scans,
                                      const std::string& option);

/// The option --bin. @throws InvalidOptions
BinLayout parse_bin(const std::string& text);

constexpr const char* kBinHelp = "what .bin files are: kitti (x y z intensity) or nuscenes (x y z intensity ring)";

constexpr const char* kUnitHelp =
    "unit of the coordinates, m (assumed), mm, ft or us-ft; SCAN=UNIT for one scan or file; results are in metres";

/// The paths of `scans` with the units of the option --unit, of which the last that names a scan holds, and where none
/// does, the last that stands for all. SCAN is a scan's name, number, path, or the file it is in.
/// @throws InvalidOptions
std::vector<std::filesystem::path> with_units(const std::vector<std::filesystem::path>& scans,
                                              const std::vector<std::string>& units);

/// What --init has in place of a file's name for the poses that scans have in their own files.
constexpr std::string_view kFromHeaders = "headers";

/// The initial poses of --init; none where it is not given.
/// @throws InputError      they cannot be read
/// @throws InvalidOptions  they are to come from the scans' files, and none has one
InitialPoses read_guess(const ScanSetOptions& options, const std::vector<std::filesystem::path>& paths);

/// Reports to the console, which must outlive it.
RunContext run_context(const ScanSetOptions& options, std::size_t num_scans, Console& console);

/// The work folder; nullptr where `folder` is empty. @param context  is told of damaged files; outlives the store
std::shared_ptr<const StepStore> open_work_folder(const std::string& folder, const RunContext& context);

/// Says how many steps were taken from the work folder and how many done.
void report_steps(const StepStore& steps, const RunContext& context);

/// Date and time on the clock of the place, ISO 8601 with the offset to UTC.
std::string time_now();

/// The command line as the user typed it, for the report.
std::string command_line(std::string_view command, const Arguments& arguments);

}  // namespace tcm_icp::app
