// tcm-icp sample, plan, match, write: the steps of a registration, one by one (solve: cmd_register.cpp).

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <optional>

#include "command.hpp"
#include "console.hpp"
#include "epsg_text.hpp"
#include "register_options.hpp"
#include "run_setup.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/match_plan.hpp"
#include "tcm_icp/pipeline/write_scan.hpp"

namespace tcm_icp::app {
namespace {

namespace fs = std::filesystem;

/// What all steps have to begin with.
struct Step {
  Step(std::string_view name, const Arguments& arguments) : options(parse_step_options(name, arguments)) {
    if (options.help) print_step_help(name, std::cout);
  }

  /// @param num_scans  that are in memory together
  void start(std::size_t num_scans) {
    catch_interrupts();
    console.emplace(options.quiet, options.verbose);
    context = run_context(options, num_scans, *console);
    steps = open_work_folder(options.work, context);
  }

  std::vector<fs::path> find_paths(std::string_view usage) const {
    if (options.scans.empty()) {
      throw InvalidOptions("no scan is given; name the files: tcm-icp " + std::string(usage));
    }
    return with_units(find_scans(options.scans, parse_bin(options.bin)).scans, options.units);
  }

  void finish() {
    console->finish();
    report_steps(*steps, context);
  }

  StepOptions options;
  std::optional<Console> console;
  RunContext context;
  std::shared_ptr<const StepStore> steps;
};

struct Block {
  std::size_t number = 0, of = 0;
};

Block parse_block(const std::string& text) {
  if (text.empty()) throw InvalidOptions("--block K/N is missing: which part of the pairs? 1/1 is all of them");
  Block block;
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, block.number);
  if (error == std::errc() && slash != end && *slash == '/') {
    const auto [rest, second] = std::from_chars(slash + 1, end, block.of);
    if (second == std::errc() && rest == end && block.number >= 1 && block.number <= block.of) return block;
  }
  throw InvalidOptions("--block '" + text + "': give K/N, block K of N, with K from 1 to N");
}

}  // namespace

int cmd_sample(const Arguments& arguments) {
  Step step("sample", arguments);
  if (step.options.help) return kSuccess;
  const auto paths = step.find_paths("sample SCAN... --work DIR");
  step.start(1);
  for (const auto& path : paths) sample_into(*step.steps, path, step.options.pipeline, step.context);
  step.finish();
  return kSuccess;
}

int cmd_plan(const Arguments& arguments) {
  Step step("plan", arguments);
  if (step.options.help) return kSuccess;
  const auto paths = step.find_paths("plan SCAN... --work DIR");
  step.start(paths.size());
  const MatchPlan plan = plan_matches(*step.steps, scans_in_files(paths), step.options.pipeline, step.context);
  write_plan(*step.steps, plan);
  step.finish();
  std::cout << plan.pairs.size() << " pairs of " << plan.scans.size() << " scans\n";
  return kSuccess;
}

int cmd_match(const Arguments& arguments) {
  Step step("match", arguments);
  if (step.options.help) return kSuccess;
  if (!step.options.scans.empty()) {
    throw InvalidOptions("'" + step.options.scans.front() + "': match takes no scans, they are in the plan");
  }
  const Block block = parse_block(step.options.block);
  step.start(1);
  match_block(*step.steps, read_plan(*step.steps), block.number, block.of, step.options.pipeline, step.context);
  step.finish();
  return kSuccess;
}

int cmd_write(const Arguments& arguments) {
  Step step("write", arguments);
  if (step.options.help) return kSuccess;
  const auto paths = step.find_paths("write SCAN... --work DIR --out DIR");
  if (step.options.out.empty()) {
    throw InvalidOptions("--out DIR is missing: where is the result that the poses are in?");
  }
  const PoseFile poses = read_pose_file(fs::path(step.options.out) / "poses.json");
  step.start(1);
  OutputOptions clouds = step.options.clouds;
  clouds.crs_text = epsg_text(poses.crs).value_or("");
  bool all_registered = true;
  for (const auto& path : paths) {
    const auto written =
        write_scan(*step.steps, step.options.out, path, poses, step.options.pipeline, clouds, step.context);
    if (written) continue;
    step.context.warn(path.string() + " is unregistered: it is not written");
    all_registered = false;
  }
  step.finish();
  return all_registered ? kSuccess : kSomeUnregistered;
}

}  // namespace tcm_icp::app
