#include "register_options.hpp"

#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <fstream>
#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>
#include <string_view>

#include "option_descriptions.hpp"
#include "parse_arguments.hpp"
#include "register_choices.hpp"
#include "run_setup.hpp"
#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {
namespace {

namespace po = boost::program_options;

// What `register --help` shows: what to write, how to run, and what most sets of scans may need.
constexpr std::array kUsedMost{"out",
                               "force",
                               "work",
                               "config",
                               "format",
                               "each",
                               "init",
                               "bin",
                               "unit",
                               "control",
                               "gnss",
                               "fix",
                               "crs",
                               "accept-residual",
                               "accept-overlap",
                               "accept-sigma",
                               "reference",
                               "level",
                               "profile",
                               "confidence",
                               "outliers",
                               "method",
                               "seed",
                               "threads",
                               "quiet",
                               "verbose",
                               "help",
                               "help-all"};

// Once the text has become options.
void finish(ScanSetOptions& o, const Choices& choices) {
  choices.apply(o.pipeline);
  num_threads(o.threads);
  memory_bytes(o.memory);
  o.pipeline.validate();
}

// The library takes -1 for the largest whole number there is.
void refuse_negative_counts(const po::parsed_options& parsed, const po::variables_map& map) {
  for (const auto& option : parsed.options) {
    const auto at = map.find(option.string_key);
    if (at == map.end() || boost::any_cast<std::uint64_t>(&at->second.value()) == nullptr) continue;
    if (option.value.at(0).front() == '-') {
      throw InvalidOptions("--" + option.string_key + " must be at least 0, not " + option.value[0]);
    }
  }
}

void store_checked(const po::parsed_options& parsed, po::variables_map& map) {
  po::store(parsed, map);
  refuse_negative_counts(parsed, map);
}

void read_config(const std::string& path, const po::options_description& options, po::variables_map& map) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) {
    throw InputError(path, "", "the option file cannot be opened", "check the path given to --config");
  }
  std::stringstream text;
  text << in.rdbuf();
  refuse_placeholders(text.str(), path);
  try {
    store_checked(po::parse_config_file(text, options), map);
  } catch (const po::unknown_option& e) {
    const std::string what = unknown_option_error(e, options, "").what();
    throw InvalidOptions(joined(path + ": " + what, "--print-config shows what may stand there"));
  } catch (const po::error& e) {
    throw InvalidOptions(path + ": " + e.what() + "; --print-config shows what may stand there");
  }
}

// Reads both, the command line and the file that it names.
void read_options(RegisterOptions& o, Choices& choices, const po::options_description& general,
                  const Arguments& arguments) {
  const po::options_description file_options = configurable(o, choices);
  po::options_description scans;
  scans.add_options()("scan", po::value(&o.scans));
  po::options_description all;
  all.add(general).add(file_options).add(scans);

  po::variables_map map;
  store_checked(parse_arguments(arguments, all, "scan"), map);
  if (map.count("config") != 0) read_config(map["config"].as<std::string>(), file_options, map);
  po::notify(map);
  choices.apply_beside_pipeline(o);
  if (o.method != Method::kTcm) choices.use_conventional_defaults(!map["outliers"].defaulted());
  finish(o, choices);
}

struct StepText {
  std::string_view command, usage, text;
};

constexpr std::array kSteps{
    StepText{"sample", "sample SCAN... --work DIR [OPTIONS]",
             "Step 1 of a registration: reads scans, and keeps in the work folder what stands for each from then on."},
    StepText{
        "plan", "plan SCAN... --work DIR [OPTIONS]",
        "Step 2 of a registration: ranks all pairs of all scans, and writes down in the work folder which to search\n"
        "first (plan.json). Says how many there are."},
    StepText{
        "match", "match --work DIR --block K/N [OPTIONS]",
        "Step 3 of a registration: searches block K of N of the pairs that were planned, and keeps what it finds."},
    StepText{
        "solve", "solve SCAN... --work DIR --out DIR [OPTIONS]",
        "Step 4 of a registration: poses and report from what is in the work folder; what is not there is done. The\n"
        "points of the scans are not read again: there is no merged cloud, and there are no pictures."},
    StepText{
        "write", "write SCAN... --work DIR --out DIR [OPTIONS]",
        "Step 5 of a registration: writes scans of a solved one in the common frame, each to a file in scans/, as\n"
        "'tcm-icp register --each' does."}};

}  // namespace

RegisterOptions parse_register_options(const Arguments& arguments) {
  RegisterOptions o;
  Choices choices(o);
  std::string config;
  read_options(o, choices, command_line_only(o, config), arguments);
  return o;
}

StepOptions parse_step_options(std::string_view command, const Arguments& arguments) {
  StepOptions o;
  Choices choices(o);
  std::string config;
  read_options(o, choices, step_command_line(command, o, config), arguments);
  if (o.help) return o;
  if (o.method != Method::kTcm) throw InvalidOptions("--method: only tcm has steps; leave it out");
  if (o.work.empty()) {
    throw InvalidOptions("--work DIR is missing: where are the steps to be kept?");
  }
  return o;
}

void print_step_help(std::string_view command, std::ostream& out) {
  StepOptions o;
  Choices choices(o);
  const po::options_description file_options = configurable(o, choices);
  po::options_description of_registration("Of the registration, among others");
  for (const char* name : {"bin", "unit", "seed", "threads", "memory"}) {
    of_registration.add(boost::make_shared<po::option_description>(file_options.find(name, false)));
  }
  std::string config;
  const auto* const step =
      std::find_if(kSteps.begin(), kSteps.end(), [&](const StepText& s) { return s.command == command; });
  out << "Usage: tcm-icp " << step->usage << "\n\n"
      << step->text
      << "\nAll steps of a registration take the same options as 'tcm-icp register', best by one --config file.\n\n"
      << step_command_line(command, o, config) << '\n'
      << of_registration
      << "\n'tcm-icp register --help-all' lists the other options; docs/cluster.md shows how steps are run.\n";
}

InspectOptions parse_inspect_options(const Arguments& arguments) {
  InspectOptions o;
  Choices choices(o.pipeline);
  po::options_description all = inspect_description(o, choices);
  all.add_options()("scan", po::value(&o.scans));
  po::variables_map map;
  store_checked(parse_arguments(arguments, all, "scan"), map);
  po::notify(map);
  finish(o, choices);
  return o;
}

void print_inspect_help(std::ostream& out) {
  InspectOptions o;
  Choices choices(o.pipeline);
  out << "Usage: tcm-icp inspect SCAN... [--json] [--init POSES.json] [OPTIONS]\n\n"
         "What is known of scans before they are registered: counts, extents, spacing and noise; of two or more also\n"
         "the TCM of each pair and the correspondence graph with the reference scan it chooses, at the initial poses;\n"
         "scans without one are taken as they lie.\n\n"
      << inspect_description(o, choices)
      << "\nExample: tcm-icp inspect datasets/town/*.ply --init datasets/town/initial_poses.json\n";
}

void print_register_help(Help which, std::ostream& out) {
  RegisterOptions o;
  Choices choices(o);
  std::string config;
  out << "Usage: tcm-icp register SCAN... --out DIR [OPTIONS]\n\n"
         "Puts overlapping LiDAR scans (PLY, LAS, E57, PCD, PTX, PTS, text), wherever each lies, into the frame of\n"
         "one of them. SCAN is a file, a folder, a pattern, or one scan of a file (hall.ptx#2). DIR receives "
         "poses.json,\n"
         "poses/, transforms/, registered.ply, preview.png, report.json and report.html. Lengths are in the unit of "
         "the scans.\n\n";
  const po::options_description general = command_line_only(o, config), file_options = configurable(o, choices);
  if (which == Help::kAll) {
    out << general << '\n' << file_options;
  } else {
    po::options_description most("Options used most; --help-all lists all");
    for (const char* name : kUsedMost) {
      const auto* option = general.find_nothrow(name, false);
      most.add(
          boost::make_shared<po::option_description>(option != nullptr ? *option : file_options.find(name, false)));
    }
    out << most;
  }
  out << "\nExample: tcm-icp register datasets/town/*.ply --out out/town\n";
}

void print_register_config(const RegisterOptions& options, std::ostream& out) {
  RegisterOptions o = options;
  Choices choices(o);
  // The defaults of a description made from the effective values are the effective values.
  const po::options_description description = configurable(o, choices);
  po::variables_map map;
  po::store(po::command_line_parser(Arguments{}).options(description).run(), map);
  out << "# tcm-icp register --config FILE\n" << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const auto& unit : o.units) out << "unit = " << unit << '\n';
  for (const auto& fixed : o.survey.fixed) out << "fix = " << fixed << '\n';
  for (const auto& sigma : o.survey.level_sigmas_deg) out << "level-sigma = " << sigma << '\n';
  for (const auto& option : description.options()) {
    const std::string& name = option->long_name();
    if (name == "unit" || name == "fix" || name == "level-sigma") continue;  // as many as were given, or none
    const boost::any& v = map[option->long_name()].value();
    out << option->long_name() << " = ";
    if (const auto* text = boost::any_cast<std::string>(&v)) out << *text;
    if (const auto* yes = boost::any_cast<bool>(&v)) out << (*yes ? "true" : "false");
    if (const auto* number = boost::any_cast<double>(&v)) out << *number;
    if (const auto* number = boost::any_cast<int>(&v)) out << *number;
    if (const auto* number = boost::any_cast<std::uint64_t>(&v)) out << *number;
    out << '\n';
  }
}

}  // namespace tcm_icp::app
