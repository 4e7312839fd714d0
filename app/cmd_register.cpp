// tcm-icp register: scans in, merged cloud, poses and report out.

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "command.hpp"
#include "console.hpp"
#include "register_options.hpp"
#include "run_setup.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"
#include "tcm_icp/pipeline/result_writer.hpp"
#include "version.hpp"

namespace tcm_icp::app {
namespace {

void check_usage(const RegisterOptions& o) {
  if (o.scans.size() < 2) {
    throw InvalidOptions("registration needs at least two scans, not " + std::to_string(o.scans.size()) +
                         "; name the files: tcm-icp register SCAN... --out DIR");
  }
  if (o.out.empty()) throw InvalidOptions("--out DIR is missing: where is the result to go?");
}

void print_table(const PipelineResult& result, std::ostream& out) {
  std::size_t width = 4;
  for (const auto& s : result.scans) width = std::max(width, s.file.size());
  out << std::left << std::setw(static_cast<int>(width)) << "scan"
      << "  " << std::setw(13) << "status" << std::right << std::setw(9) << "overlap" << std::setw(9) << "in noise"
      << std::setw(12) << "residual"
      << "  reason\n";
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const auto& pose = result.poses[i];
    const auto& evidence = result.evidence[i];
    const char* status = pose.status == ScanStatus::kReference      ? "reference"
                         : pose.status == ScanStatus::kUnregistered ? "unregistered"
                                                                    : "registered";
    out << std::left << std::setw(static_cast<int>(width)) << pose.file << "  " << std::setw(13) << status
        << std::right;
    if (evidence) {
      const auto percent = [](double share) { return std::to_string(static_cast<int>(100 * share + 0.5)) + " %"; };
      out << std::setw(9) << percent(evidence->overlap) << std::setw(9) << percent(evidence->inlier_share)
          << std::setw(12) << std::setprecision(3) << evidence->median_residual_m;
    } else {
      out << std::setw(30) << "";
    }
    out << "  " << pose.reason << '\n';
  }
}

}  // namespace

int cmd_register(const Arguments& arguments) {
  const RegisterOptions o = parse_register_options(arguments);
  if (o.help) {
    print_register_help(std::cout);
    return kSuccess;
  }
  if (o.print_config) {
    print_register_config(o, std::cout);
    return kSuccess;
  }
  check_usage(o);
  const auto paths = paths_of(o);
  check_output_folder(o.out, o.force);
  const InitialPoses guess = read_guess(o, paths);

  catch_interrupts();
  Console console(o.quiet, o.verbose);
  const RunContext context = run_context(o, console);

  PipelineResult result = Pipeline(o.pipeline).run(paths, guess, context);
  write_result(o.out, o.force, paths, result, o.pipeline, context,
               {kVersion, command_line("register", arguments), o.initial_poses});
  console.finish();
  if (!o.quiet) print_table(result, std::cout);
  return result.all_registered() ? kSuccess : kSomeUnregistered;
}

}  // namespace tcm_icp::app
