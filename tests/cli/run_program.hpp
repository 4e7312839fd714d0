#pragma once
// Runs tcm-icp as a user does, and tells what it did.

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tcm_icp::test {

using Words = std::vector<std::string>;

/// `a` and then `b`.
Words operator+(Words a, const Words& b);

struct RunResult {
  int exit_code = -1;  ///< -1 where a signal ended it
  int signal = 0;      ///< that signal
  std::string out, err;
  double peak_memory_mb = 0;
};

struct RunSettings {
  std::filesystem::path folder;       ///< to run in
  std::size_t max_file_bytes = 0;     ///< no file may grow larger, as on a full disk; 0: no limit
  std::string interrupt_at;           ///< Ctrl-C (SIGINT) as soon as stderr has this; empty: never
  int kill_after_ms = 0;              ///< SIGKILL, if it still runs then; 0: never
  std::filesystem::path stdout_file;  ///< where stdout goes; empty: it is caught
};

/// @throws std::runtime_error  if the program cannot be started
RunResult run_program(const Words& arguments, const RunSettings& settings);

/// The scans of datasets/town with these numbers, as arguments.
Words town_scans(const std::vector<int>& numbers = {0, 1, 2, 3, 4, 5});
std::filesystem::path town_file(const std::string& name);

/// Every file and folder under `folder`.
std::set<std::filesystem::path> everything_in(const std::filesystem::path& folder);

}  // namespace tcm_icp::test
