#include "parse_arguments.hpp"

#include <algorithm>
#include <boost/program_options/errors.hpp>
#include <boost/program_options/positional_options.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <string>
#include <thread>

#include "option_binding.hpp"
#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {

namespace po = boost::program_options;

po::error unknown_option_error(const po::unknown_option& error, const po::options_description& options,
                               const char* dashes) {
  std::string typed = error.get_option_name();
  typed.erase(0, std::min(typed.find_first_not_of('-'), typed.size()));
  std::vector<std::string> known;
  for (const auto& option : options.options()) {
    if (!option->description().empty()) known.push_back(option->long_name());  // no help: not for users
  }
  return po::error(error.what() + did_you_mean(typed, known, dashes));
}

void refuse_placeholders(const std::string& text, const std::string& where) {
  for (const char* const placeholder : {"%original_token%", "%canonical_option%", "%option%", "%prefix%", "%value%"}) {
    if (text.find(placeholder) == std::string::npos) continue;
    throw InvalidOptions(where + " holds " + placeholder + ", which no option and no name may; write it otherwise");
  }
}

po::parsed_options parse_arguments(const Arguments& arguments, const po::options_description& options,
                                   const char* positional) {
  constexpr int kStyle = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  for (const std::string& argument : arguments) refuse_placeholders(argument, "the command line");
  po::positional_options_description places;
  if (*positional != '\0') places.add(positional, -1);
  try {
    return po::command_line_parser(arguments).options(options).positional(places).style(kStyle).run();
  } catch (const po::unknown_option& e) {
    throw unknown_option_error(e, options, "--");
  }
}

void add_run_options(RunOptions& run, po::options_description& to) {
  to.add_options()("threads", bind_option(&run.threads), kThreadsHelp)  //
      ("quiet,q", po::bool_switch(&run.quiet), kQuietHelp)              //
      ("verbose,v", po::bool_switch(&run.verbose), kVerboseHelp);
}

int num_threads(int asked) {
  if (asked < 0) throw InvalidOptions("--threads must be at least 0, not " + std::to_string(asked));
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace tcm_icp::app
