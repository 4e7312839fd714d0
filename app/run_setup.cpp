#include "run_setup.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <ctime>
#include <map>

#include "parse_arguments.hpp"
#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/memory_limit.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"
#include "values_by_scan.hpp"

namespace tcm_icp::app {
namespace {

LengthUnit parse_unit(const std::string& option, const std::string& name) {
  if (const auto unit = unit_from_name(name)) return *unit;
  throw InvalidOptions("--unit " + option + ": choose one of m, mm, ft, us-ft" +
                       did_you_mean(name, {"m", "mm", "ft", "us-ft"}));
}

InitialPoses poses_in_headers(const std::vector<std::filesystem::path>& paths) {
  InitialPoses poses;
  for (const auto& path : paths) poses.push_back(ScanReader(path, ReadAttributes::kNo).header_pose());
  const bool has_any = std::any_of(poses.begin(), poses.end(), [](const auto& pose) { return pose.has_value(); });
  if (has_any) return poses;
  throw InvalidOptions(
      "--init headers: no scan has a pose in its file; only PTX and E57 have them; leave it out, and poses are "
      "searched");
}

// So that a POSIX shell takes it as one word.
std::string shell_word(const std::string& argument) {
  const bool plain = !argument.empty() && std::all_of(argument.begin(), argument.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) != 0 || std::strchr("_@%+=:,./-", c) != nullptr;
  });
  if (plain) return argument;
  std::string out = "'";
  for (const char c : argument) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  return out + "'";
}

}  // namespace

std::string report_coordinate_systems(const std::vector<std::filesystem::path>& scans, const std::string& what,
                                      const RunContext& context) {
  constexpr std::size_t kMostShown = 60;                 // well-known text fills a page
  std::map<std::string, std::filesystem::path> systems;  // each with the first scan in it
  for (const auto& scan : scans) {
    const std::string system = ScanReader(scan, ReadAttributes::kNo).coordinate_system();
    if (!system.empty()) systems.emplace(system, scan);
  }
  for (const auto& [system, scan] : systems) {
    const std::string shown = system.size() > kMostShown ? system.substr(0, kMostShown) + "..." : system;
    const std::string text = scan.filename().string() + " is in the coordinate system " + shown;
    if (systems.size() > 1) {
      context.warn(text + "; others are in another: are all in one unit?");
    } else {
      context.info(text + ", " + what);
    }
  }
  return systems.size() == 1 ? systems.begin()->first : "";
}

BinLayout parse_bin(const std::string& text) {
  if (text.empty()) return BinLayout::kNone;
  if (text == "kitti") return BinLayout::kKitti;
  if (text == "nuscenes") return BinLayout::kNuScenes;
  throw InvalidOptions("--bin '" + text + "': choose one of kitti, nuscenes" +
                       did_you_mean(text, {"kitti", "nuscenes"}));
}

std::vector<std::size_t> scans_called(const std::string& name, const std::vector<std::filesystem::path>& scans,
                                      const std::string& option) {
  const std::vector<std::string> names = scan_names(scans);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::filesystem::path file = parse_scan_path(scans[i]).file;
    const bool is_called =
        name == names[i] || name == scans[i] || name == file || name == file.filename() || name == std::to_string(i);
    if (is_called) found.push_back(i);
  }
  if (!found.empty()) return found;
  throw InvalidOptions(option + ": no scan is called '" + name + "'" + did_you_mean(name, names));
}

std::vector<std::filesystem::path> with_units(const std::vector<std::filesystem::path>& scans,
                                              const std::vector<std::string>& units) {
  const auto unit_of = values_by_scan<LengthUnit>(units, "--unit", scans, parse_unit);
  std::vector<std::filesystem::path> out = scans;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (unit_of[i]) out[i] = with_unit(scans[i], *unit_of[i]);
  }
  return out;
}

void report_left_out(const ScanInputs& inputs, const RunContext& context) {
  constexpr std::size_t kMost = 5;  // a folder may hold a thousand photos
  for (std::size_t i = 0; i < std::min(kMost, inputs.left_out.size()); ++i) {
    context.warn("left out: " + inputs.left_out[i]);
  }
  if (inputs.left_out.size() > kMost) {
    context.warn("left out: " + std::to_string(inputs.left_out.size() - kMost) + " more files");
  }
}

InitialPoses read_guess(const ScanSetOptions& options, const std::vector<std::filesystem::path>& paths) {
  if (options.initial_poses.empty()) return InitialPoses(paths.size());
  if (options.initial_poses == kFromHeaders) return poses_in_headers(paths);
  return read_initial_poses(options.initial_poses, scan_names(paths));
}

RunContext run_context(const ScanSetOptions& options, std::size_t num_scans, Console& console) {
  RunContext context;
  context.seed = options.seed;
  context.num_threads = num_threads(options.threads);
  context.memory_limit = memory_bytes(options.memory).value_or(default_memory_limit(num_scans));
  context.on_progress = [&console](const Progress& p) { return console.progress(p); };
  context.log = [&console](LogLevel level, std::string_view message) { console.log(level, message); };
  return context;
}

std::shared_ptr<const StepStore> open_work_folder(const std::string& folder, const RunContext& context) {
  if (folder.empty()) return nullptr;
  return std::make_shared<StepStore>(folder, [&context](std::string_view message) { context.warn(message); });
}

void report_steps(const StepStore& steps, const RunContext& context) {
  std::string text;
  for (const auto& [kind, count] : steps.counts()) {
    text += (text.empty() ? "" : "; ") + kind + ": " + std::to_string(count.num_found) + " there, " +
            std::to_string(count.num_made) + " done";
  }
  context.info("steps in " + steps.folder().string() + ": " + (text.empty() ? "none" : text));
}

std::string time_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  char clock[32], offset[8];
  std::strftime(clock, sizeof clock, "%Y-%m-%dT%H:%M:%S", &parts);
  std::strftime(offset, sizeof offset, "%z", &parts);  // +0100, which is +01:00 in the form of the clock
  std::string time(clock);
  time.append(offset, 3).append(":").append(offset + 3);
  return time;
}

std::string command_line(std::string_view command, const Arguments& arguments) {
  std::string line = "tcm-icp " + std::string(command);
  for (const auto& a : arguments) line.append(" ").append(shell_word(a));
  return line;
}

}  // namespace tcm_icp::app
