#pragma once
// A result folder that is there whole or not at all.

#include <filesystem>
#include <string>
#include <vector>

namespace tcm_icp {

/// Results are written into a temporary folder beside the final one and renamed by commit(). Without commit() (an
/// error, an interrupt that unwinds) the temporary folder and the parents made for it are removed, and the final place
/// is as it was.
class OutputFolder {
 public:
  /// Makes the temporary folder, and the parents of `path` where they are missing.
  /// @param force   an existing folder may be replaced, if it is empty or holds the file `marker` that such a result
  ///                has: a mistyped path must not cost somebody's data
  /// @throws OutputError  if the folder exists and must not be replaced, or the temporary one cannot be made
  OutputFolder(const std::filesystem::path& path, bool force, std::string marker);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Write here.
  const std::filesystem::path& work() const { return work_; }

  /// @throws OutputError  if somebody else has put something there meanwhile that must not be replaced, or the rename
  ///                      fails; what was there is then still there
  void commit();

 private:
  void remove_all() noexcept;

  std::filesystem::path path_, work_;
  bool force_;
  std::string marker_;
  std::vector<std::filesystem::path> made_parents_;  ///< outermost first
};

}  // namespace tcm_icp
