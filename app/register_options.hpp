#pragma once
// The options of `tcm-icp register` and `tcm-icp inspect`: bound to the library's structs, whose defaults they show.

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/variables_map.hpp>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "tcm_icp/io/output_options.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/report_options.hpp"

namespace tcm_icp::app {

/// What every command that reads a set of scans asks for.
struct ScanSetOptions {
  PipelineOptions pipeline;
  std::vector<std::string> scans;
  std::string initial_poses;
  std::string bin;                 ///< what .bin files are
  std::vector<std::string> units;  ///< of coordinates: UNIT, or SCAN=UNIT
  std::uint64_t seed = 42;
  int threads = 0;              ///< 0: as many as the machine has
  std::string memory = "auto";  ///< to stay below: "4G"
  bool quiet = false;
  bool verbose = false;
  bool help = false;
};

/// What defines the common frame in place of the reference scan.
struct SurveyOptions {
  std::string control;                        ///< file of control points
  std::string positions;                      ///< file of scanners' positions
  std::vector<std::string> fixed;             ///< scans that stay where the initial poses put them
  std::string crs;                            ///< EPSG:n, well-known text, or a file of it
  std::vector<std::string> level_sigmas_deg;  ///< DEG, or SCAN=DEG; 0: need not be upright
};

enum class Method { kTcm, kIcp, kFeatures };

struct RegisterOptions : ScanSetOptions {
  OutputOptions clouds;
  SurveyOptions survey;
  ReportOptions report;
  Method method = Method::kTcm;
  std::string out;
  std::string work;  ///< folder that keeps finished steps; empty: none
  bool force = false;
  bool print_config = false;
  bool help_all = false;
};

/// A step of a registration by itself: the options of the registration, and which step.
struct StepOptions : RegisterOptions {
  std::string block;  ///< "3/20"
};

struct InspectOptions : ScanSetOptions {
  bool json = false;
};

/// Command line first, then the file of --config: what the command line says wins.
/// @throws InvalidOptions, boost::program_options::error
RegisterOptions parse_register_options(const Arguments& arguments);

enum class Help { kUsedMost, kAll };
void print_register_help(Help which, std::ostream& out);

/// The same of a step. @param command  "sample", "plan", "match", "solve" or "write"
StepOptions parse_step_options(std::string_view command, const Arguments& arguments);

void print_step_help(std::string_view command, std::ostream& out);

/// @throws InvalidOptions, boost::program_options::error
InspectOptions parse_inspect_options(const Arguments& arguments);

void print_inspect_help(std::ostream& out);

/// Every option with its effective value, in the form --config reads.
void print_register_config(const RegisterOptions& options, std::ostream& out);

}  // namespace tcm_icp::app
