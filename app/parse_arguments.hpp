#pragma once
// The command line of a subcommand, alike for all of them.

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/variables_map.hpp>
#include <cstddef>
#include <optional>
#include <string>

#include "command.hpp"

namespace tcm_icp::app {

/// Names of options are not shortened, so that a typo does not become another option.
/// @param positional  option that takes what is no option; empty: there is no such thing
/// @throws boost::program_options::error  which asks for the option that was meant, where one is unknown
boost::program_options::parsed_options parse_arguments(const Arguments& arguments,
                                                       const boost::program_options::options_description& options,
                                                       const char* positional = "");

/// The error about an option that `options` does not have. @param dashes  what stands before names where it was found
boost::program_options::error unknown_option_error(const boost::program_options::unknown_option& error,
                                                   const boost::program_options::options_description& options,
                                                   const char* dashes);

/// Boost's errors replace such words by what was typed, for ever where that holds them itself.
/// @throws InvalidOptions  where `text` has one. @param where  it stands, for the message
void refuse_placeholders(const std::string& text, const std::string& where);

/// What the commands have in common about how they run.
struct RunOptions {
  int threads = 0;  ///< 0: as many as the machine has
  bool quiet = false;
  bool verbose = false;
};

/// --threads, --quiet and --verbose.
void add_run_options(RunOptions& run, boost::program_options::options_description& to);

/// Threads to use, at least 1. @throws InvalidOptions  where less than 0 is asked for
int num_threads(int asked);

/// Bytes that "4G", "500M" or "1.5g" stand for, by powers of 1024; 0, no limit, for "none"; nothing for "auto".
/// @throws InvalidOptions  for other text, and for less than 64M, which no run gets by with
std::optional<std::size_t> memory_bytes(const std::string& text);

inline constexpr const char* kMemoryHelp =
    "memory to stay below where it can be, as 4G or 500M: what is not needed at once goes to a file in the folder of "
    "TMPDIR, or /var/tmp; auto: half of the machine's, and at most 2G, of more than 25 scans 256M and 2M a scan; "
    "none: no limit; the result is the same for any";
inline constexpr const char* kThreadsHelp = "threads; 0: all of the machine; the result is the same for any number";
inline constexpr const char* kQuietHelp = "errors and warnings only, beside results that go to standard output";
inline constexpr const char* kVerboseHelp = "say more of what happens";

}  // namespace tcm_icp::app
