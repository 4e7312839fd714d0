#pragma once
// What a run tells on stderr: a progress line on a terminal, plain lines otherwise; and Ctrl-C.

#include <chrono>
#include <string>

#include "tcm_icp/core/run_context.hpp"

namespace tcm_icp::app {

class Console {
 public:
  Console(bool quiet, bool verbose);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  Continue progress(const Progress& progress);
  void log(LogLevel level, std::string_view message);

  /// Ends the progress line, if there is one.
  void finish();

 private:
  bool quiet_, verbose_, terminal_;
  std::string line_, stage_;
  std::chrono::steady_clock::time_point start_;
};

/// From here on SIGINT, SIGTERM and SIGHUP ask the run to stop at its next progress report; a second one ends it at
/// once.
void catch_interrupts();

}  // namespace tcm_icp::app
