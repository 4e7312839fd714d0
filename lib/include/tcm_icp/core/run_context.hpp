#pragma once
// What a run carries along: seed, threads, progress, log, cancellation.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace tcm_icp {

/// How far a stage is.
struct Progress {
  std::string_view stage;  ///< "reading", "comparing", ...
  std::size_t done = 0;    ///< scans or pairs that are done
  std::size_t total = 0;   ///< 0 where it is not known
};

/// What a progress callback answers.
enum class Continue {
  kYes,  ///< go on
  kStop  ///< end the run with Cancelled
};

/// How much a message matters.
enum class LogLevel {
  kDebug,   ///< of use to who looks for a defect
  kInfo,    ///< what was found on the way
  kWarning  ///< what may make the result wrong
};

/// What a run carries along. The library itself prints nothing.
struct RunContext {
  std::uint64_t seed = 42;                               ///< each stage draws from make_stream(seed, stage)
  int num_threads = 1;                                   ///< >= 1; changes speed, never the result
  std::size_t memory_limit = 0;                          ///< [bytes] kept where it can be; 0: none; changes no result
  std::function<Continue(const Progress&)> on_progress;  ///< may be empty; called from one thread
  std::function<void(LogLevel, std::string_view)> log;   ///< may be empty

  /// Reports progress. @throws Cancelled  if on_progress answers kStop
  void report(std::string_view stage, std::size_t done, std::size_t total) const;
  /// Hands a message to `log`, where there is one.
  void info(std::string_view message) const {
    if (log) log(LogLevel::kInfo, message);
  }
  /// The same of kDebug.
  void debug(std::string_view message) const {
    if (log) log(LogLevel::kDebug, message);
  }
  /// The same of kWarning.
  void warn(std::string_view message) const {
    if (log) log(LogLevel::kWarning, message);
  }
};

}  // namespace tcm_icp
