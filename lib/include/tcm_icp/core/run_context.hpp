#pragma once
// What a run carries along: seed, threads, progress, log, cancellation.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace tcm_icp {

struct Progress {
  std::string_view stage;
  std::size_t done = 0;
  std::size_t total = 0;  ///< 0 where it is not known
};

enum class Continue { kYes, kStop };
enum class LogLevel { kDebug, kInfo, kWarning };

struct RunContext {
  std::uint64_t seed = 42;                               ///< each stage draws from make_stream(seed, stage)
  int num_threads = 1;                                   ///< >= 1; changes speed, never the result
  std::function<Continue(const Progress&)> on_progress;  ///< may be empty; called from one thread
  std::function<void(LogLevel, std::string_view)> log;   ///< may be empty

  /// Reports progress. @throws Cancelled  if on_progress answers kStop
  void report(std::string_view stage, std::size_t done, std::size_t total) const;
  void info(std::string_view message) const {
    if (log) log(LogLevel::kInfo, message);
  }
  void debug(std::string_view message) const {
    if (log) log(LogLevel::kDebug, message);
  }
  void warn(std::string_view message) const {
    if (log) log(LogLevel::kWarning, message);
  }
};

}  // namespace tcm_icp
