#pragma once
// A result folder that is there whole or not at all.

#include <filesystem>
#include <string>

namespace tcm_icp::app {

/// Results are written into a temporary folder beside the final one and renamed by commit(). Without commit() (an
/// error, an interrupt that unwinds) the temporary folder is removed and the final place is as it was.
class OutputFolder {
 public:
  /// @param force   an existing folder may be replaced, if it is empty or holds the file `marker` that such a result
  /// has:
  ///                a mistyped path must not cost somebody's data
  /// @throws OutputError  if the folder exists and must not be replaced, or the temporary one cannot be made
  OutputFolder(const std::filesystem::path& path, bool force, const std::string& marker);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Write here.
  const std::filesystem::path& work() const { return work_; }

  /// @throws OutputError  if the rename fails; an earlier result is then still there
  void commit();

 private:
  std::filesystem::path path_, work_;
};

}  // namespace tcm_icp::app
