#include "tcm_icp/io/output_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace fs = std::filesystem;
namespace {

fs::path beside(const fs::path& path, const std::string& suffix) {
  fs::path out = path;
  out += suffix + std::to_string(getpid());
  return out;
}

/// Absolute and without a slash at the end, so that a suffix can be put behind the name.
fs::path plain(const fs::path& path) {
  const fs::path absolute = fs::absolute(path).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

void refuse_if_not_replaceable(const fs::path& path, bool force, const std::string& marker) {
  const fs::file_status status = fs::symlink_status(path);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) {
    throw OutputError(path, fs::is_symlink(status) ? "is a link" : "is a file",
                      "name a folder that does not exist yet");
  }
  if (!force) throw OutputError(path, "exists already", "choose another folder, or give --force to replace it");
  if (!fs::is_empty(path) && !fs::exists(path / marker)) {
    throw OutputError(path, "is not an earlier result (it has no " + marker + ")",
                      "choose another folder; --force replaces results only");
  }
}

std::vector<fs::path> missing_parents(const fs::path& path) {
  std::vector<fs::path> missing;
  for (fs::path p = path.parent_path(); !fs::exists(p); p = p.parent_path()) missing.push_back(p);
  std::reverse(missing.begin(), missing.end());
  return missing;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& path, bool force, std::string marker)
    : path_(plain(path)), work_(beside(path_, ".part")), force_(force), marker_(std::move(marker)) {
  try {
    refuse_if_not_replaceable(path_, force_, marker_);
    for (const auto& parent : missing_parents(path_)) {
      if (fs::create_directory(parent)) made_parents_.push_back(parent);
    }
    if (!fs::create_directory(work_)) throw OutputError(work_, "is left from another run", "remove it");
  } catch (const fs::filesystem_error& e) {
    remove_all();
    throw OutputError(path_, "cannot be made: " + e.code().message(),
                      "check that its parent is a folder that can be written to, and the disk's free space");
  }
}

OutputFolder::~OutputFolder() { remove_all(); }

void OutputFolder::remove_all() noexcept {
  std::error_code ignored;  // nobody to tell; what is left is named .part
  if (!work_.empty()) fs::remove_all(work_, ignored);
  // Only where they are empty: another run may have put its result there.
  for (auto parent = made_parents_.rbegin(); parent != made_parents_.rend(); ++parent) fs::remove(*parent, ignored);
}

void OutputFolder::commit() {
  try {
    refuse_if_not_replaceable(path_, force_, marker_);
    const fs::path old = beside(path_, ".old");
    const bool replaces = fs::exists(path_);
    if (replaces) fs::rename(path_, old);
    std::error_code failure;
    fs::rename(work_, path_, failure);
    if (failure && replaces) fs::rename(old, path_);
    if (failure) throw OutputError(path_, "cannot be put in place: " + failure.message(), "check permissions");
    work_.clear();
    made_parents_.clear();
    if (replaces) fs::remove_all(old);
  } catch (const fs::filesystem_error& e) {
    throw OutputError(path_, "cannot be put in place: " + e.code().message(), "check permissions");
  }
}

}  // namespace tcm_icp
