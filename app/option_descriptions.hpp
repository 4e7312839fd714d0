#pragma once
// What the options of `register`, its steps and `inspect` are called, and what their help says.

#include <boost/program_options/options_description.hpp>
#include <string>
#include <string_view>

#include "register_choices.hpp"
#include "register_options.hpp"

namespace tcm_icp::app {

// Descriptions keep references to what they are made of: text goes to the choices, all else to the options, whose
// values are shown as defaults.

/// Options that may stand in a file, too.
boost::program_options::options_description configurable(RegisterOptions& o, Choices& c);

/// What `register` takes beside those. @param config  the file
boost::program_options::options_description command_line_only(RegisterOptions& o, std::string& config);

/// What each step takes beside what may stand in a file. @param command  "sample", "plan", "match", "solve" or "write"
boost::program_options::options_description step_command_line(std::string_view command, StepOptions& o,
                                                              std::string& config);

boost::program_options::options_description inspect_description(InspectOptions& o, Choices& c);

}  // namespace tcm_icp::app
