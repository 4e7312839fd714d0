#include "output_folder.hpp"

#include <unistd.h>

#include <system_error>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {
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
  if (!fs::exists(fs::symlink_status(path))) return;
  if (!force) throw OutputError(path, "exists", "use another folder, or --force to replace it");
  const bool replaceable =
      fs::is_directory(fs::symlink_status(path)) && (fs::is_empty(path) || fs::exists(path / marker));
  if (!replaceable)
    throw OutputError(path, "is not an earlier result (it has no " + marker + ")", "use another folder");
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& path, bool force, const std::string& marker)
    : path_(plain(path)), work_(beside(path_, ".part")) {
  try {
    refuse_if_not_replaceable(path_, force, marker);
    fs::create_directories(path_.parent_path());
    if (!fs::create_directory(work_)) throw OutputError(work_, "exists", "remove it");
  } catch (const fs::filesystem_error& e) {
    throw OutputError(path_, "cannot be made: " + e.code().message(), "check the path and its permissions");
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;  // a destructor has nobody to tell; what is left is named .part
  fs::remove_all(work_, ignored);
}

void OutputFolder::commit() {
  const fs::path old = beside(path_, ".old");
  try {
    const bool replaces = fs::exists(path_);
    if (replaces) fs::rename(path_, old);
    std::error_code failure;
    fs::rename(work_, path_, failure);
    if (failure && replaces) fs::rename(old, path_);
    if (failure) throw OutputError(path_, "cannot be put in place: " + failure.message(), "check permissions");
    if (replaces) fs::remove_all(old);
  } catch (const fs::filesystem_error& e) {
    throw OutputError(path_, "cannot be put in place: " + e.code().message(), "check permissions");
  }
}

}  // namespace tcm_icp::app
