#pragma once
// A work folder: results of finished steps, each in a file of its own that is there whole or not at all.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tcm_icp {

struct StepKey;

/// How many steps of a kind were made, and how many were found.
struct StepCount {
  std::size_t num_made = 0;
  std::size_t num_found = 0;
};

/// Results by their keys (step_key.hpp). Any number of processes, on any number of machines, may share a folder: a key
/// has one result, so that it does not matter who wrote it. Thread-safe.
///
///   DIR/steps/KIND/ab/cdef...     a result, with its length and check sum
///   DIR/unfinished/               files that are being written; those of processes that are gone are removed
///   DIR/log/HOST-PID.tsv          a line for each step made: when, kind, key, seconds, bytes
class StepStore {
 public:
  /// Makes the folder where it is missing. @param warn  of results that are damaged; may be empty
  /// @throws OutputError
  explicit StepStore(std::filesystem::path folder, std::function<void(std::string_view)> warn = {});
  ~StepStore();
  StepStore(const StepStore&) = delete;
  StepStore& operator=(const StepStore&) = delete;

  /// The result of a step; nothing where there is none, or it is damaged (then it says so).
  std::optional<std::string> find(const StepKey& key) const;

  /// Keeps a result: written beside and renamed. @param seconds  that it took, for the log
  /// @throws OutputError
  void save(const StepKey& key, std::string_view result, double seconds) const;

  /// Tells that what find() gave is no such result after all, as to who reads it: it will be made again.
  void report_damage(const StepKey& key) const;

  /// Of this process so far, by kind.
  std::map<std::string, StepCount> counts() const;

  const std::filesystem::path& folder() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes `content` beside `path`'s folder tree and renames it: readers see the earlier file or this one, whole.
/// @param beside  folder on the same file system for the unfinished file
/// @throws OutputError
void write_whole(const std::filesystem::path& path, std::string_view content, const std::filesystem::path& beside);

}  // namespace tcm_icp
