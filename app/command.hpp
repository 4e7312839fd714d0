#pragma once
// The subcommands of tcm-icp. Each takes the arguments behind its name, writes results to stdout or files and messages
// to stderr, and returns an exit code. Errors are thrown; main.cpp turns them into messages and exit codes.

#include <string>
#include <vector>

namespace tcm_icp::app {

enum ExitCode : int {
  kSuccess = 0,
  kUsageError = 1,        ///< wrong usage or options
  kInputError = 2,        ///< input that cannot be read
  kSomeUnregistered = 3,  ///< finished, but some scan is unregistered
  kOutputError = 4,       ///< output that cannot be written
  kInternalError = 70,    ///< a defect of the program
  kInterrupted = 130,
};

using Arguments = std::vector<std::string>;

int cmd_register(const Arguments& arguments);
int cmd_render(const Arguments& arguments);
int cmd_evaluate(const Arguments& arguments);
int cmd_degrade(const Arguments& arguments);
int cmd_inspect(const Arguments& arguments);
int cmd_simulate(const Arguments& arguments);
// The steps of a registration.
int cmd_sample(const Arguments& arguments);
int cmd_plan(const Arguments& arguments);
int cmd_match(const Arguments& arguments);
int cmd_solve(const Arguments& arguments);
int cmd_write(const Arguments& arguments);

}  // namespace tcm_icp::app
