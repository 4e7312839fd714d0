#include "parse_arguments.hpp"

#include <algorithm>
#include <boost/program_options/errors.hpp>
#include <boost/program_options/positional_options.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <cctype>
#include <charconv>
#include <string>
#include <string_view>
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
  for (const char* const placeholder :
       {"%original_token%", "%canonical_option%", "%option%", "%prefix%", "%value%", "%invalid_line%"}) {
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

std::optional<std::size_t> memory_bytes(const std::string& text) {
  if (text == "auto") return std::nullopt;
  if (text == "none") return 0;
  constexpr std::string_view kUnits = "MGT";
  constexpr double kLeast_mb = 64, kMost_mb = 1024.0 * 1024 * 1024;
  double megabytes = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, megabytes, std::chars_format::fixed);
  const std::size_t power = error == std::errc() && end - rest == 1
                                ? kUnits.find(static_cast<char>(std::toupper(static_cast<unsigned char>(*rest))))
                                : std::string_view::npos;
  if (power == std::string_view::npos) {
    throw InvalidOptions("--memory '" + text + "': give a size as 4G or 500M (units M, G, T), auto or none");
  }
  for (std::size_t i = 0; i < power; ++i) megabytes *= 1024;
  if (!(megabytes >= kLeast_mb && megabytes <= kMost_mb)) {
    throw InvalidOptions("--memory " + text + " is not between 64M and 1024T: no run gets by with less than 64M");
  }
  return static_cast<std::size_t>(megabytes * 1024 * 1024);
}

}  // namespace tcm_icp::app
