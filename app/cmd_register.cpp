// tcm-icp register: scans in, merged cloud, poses and report out.

#include <iostream>

#include "command.hpp"
#include "console.hpp"
#include "epsg_text.hpp"
#include "pair_methods.hpp"
#include "register_options.hpp"
#include "register_table.hpp"
#include "run_setup.hpp"
#include "survey_setup.hpp"
#include "survey_table.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/pair_pipeline.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"
#include "tcm_icp/pipeline/result_writer.hpp"
#include "text_width.hpp"
#include "version.hpp"

namespace tcm_icp::app {
namespace {

void check_number(std::size_t num_scans, std::string_view command) {
  if (num_scans >= 2) return;
  throw InvalidOptions("registration needs at least two scans, not " + std::to_string(num_scans) +
                       "; name the files: tcm-icp " + std::string(command) + " SCAN... --out DIR");
}

void check_usage(const RegisterOptions& o, std::string_view command) {
  if (o.scans.empty()) check_number(0, command);
  if (o.method == Method::kFeatures && !o.initial_poses.empty()) {
    throw InvalidOptions("--init: --method features finds its poses by itself; leave --init out, or use --method icp");
  }
  if (!o.work.empty() && o.method != Method::kTcm) {
    throw InvalidOptions("--work: --method tcm alone has steps that can be kept; leave one of the two out");
  }
  if (o.out.empty()) throw InvalidOptions("--out DIR is missing: where is the result to go?");
}

PipelineResult run_method(const RegisterOptions& o, const std::vector<std::filesystem::path>& paths,
                          const InitialPoses& guess, const Survey& survey, const RunContext& context,
                          const std::shared_ptr<const StepStore>& steps) {
  if (o.method == Method::kTcm) {
    PipelineResult result = Pipeline(o.pipeline, steps).run(paths, guess, context, survey);
    if (steps) report_steps(*steps, context);
    return result;
  }
  return register_by_pairs(paths, guess, o.pipeline, context, name_of(o.method), pair_method(o.method));
}

}  // namespace

namespace {

int run_registration(const RegisterOptions& o, std::string_view command, const Arguments& arguments) {
  check_usage(o, command);
  if (o.method != Method::kTcm) check_built_in(o.method);
  const std::string started = time_now();
  const ScanInputs inputs = find_scans(o.scans, parse_bin(o.bin));
  const auto paths = with_units(inputs.scans, o.units);
  check_number(paths.size(), command);
  check_output_folder(o.out, o.force);
  const InitialPoses guess = read_guess(o, paths);
  Survey survey = read_survey(o, paths);

  catch_interrupts();
  Console console(o.quiet, o.verbose);
  const RunContext context = run_context(o, paths.size(), console);
  report_left_out(inputs, context);
  settle_coordinate_system(o, paths, context, survey);

  OutputOptions clouds = o.clouds;
  clouds.crs_text = epsg_text(survey.crs).value_or("");
  const auto steps = open_work_folder(o.work, context);
  PipelineResult result = run_method(o, paths, guess, survey, context, steps);
  write_result(o.out, o.force, paths, result, o.pipeline, clouds, context,
               {kVersion, command_line(command, arguments), o.initial_poses, started, o.report}, steps.get());
  console.finish();
  if (!o.quiet) {
    const bool verified = o.method == Method::kTcm && o.pipeline.profile == Profile::kRobust;
    print_register_table(result, terminal_width(), std::cerr);
    print_survey_table(result.survey, terminal_width(), std::cerr);
    std::cerr << register_summary(result, verified, std::filesystem::path(o.out) / "report.html") << '\n';
  }
  return result.all_registered() ? kSuccess : kSomeUnregistered;
}

}  // namespace

int cmd_register(const Arguments& arguments) {
  const RegisterOptions o = parse_register_options(arguments);
  if (o.help || o.help_all) {
    print_register_help(o.help_all ? Help::kAll : Help::kUsedMost, std::cout);
    return kSuccess;
  }
  if (o.print_config) {
    print_register_config(o, std::cout);
    return kSuccess;
  }
  return run_registration(o, "register", arguments);
}

int cmd_solve(const Arguments& arguments) {
  StepOptions o = parse_step_options("solve", arguments);
  if (o.help) {
    print_step_help("solve", std::cout);
    return kSuccess;
  }
  o.clouds.merged = o.clouds.each = false;
  return run_registration(o, "solve", arguments);
}

}  // namespace tcm_icp::app
