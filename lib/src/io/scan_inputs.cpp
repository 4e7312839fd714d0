#include "tcm_icp/io/scan_inputs.hpp"

#include <glob.h>

#include <algorithm>
#include <system_error>

#include "scan_format.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes the digits `text` begins with; without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

void sort_naturally(std::vector<fs::path>& paths) {
  std::sort(paths.begin(), paths.end(),
            [](const fs::path& a, const fs::path& b) { return natural_less(a.native(), b.native()); });
}

bool is_result(const fs::path& folder) {
  if (!fs::exists(folder / "poses.json")) return false;
  for (const char* const name :
       {"registered.ply", "registered.las", "registered.pcd", "registered.xyz", "registered.e57", "registered.ptx"}) {
    if (fs::exists(folder / name)) return true;
  }
  return false;
}

void list_files(const fs::path& folder, std::vector<fs::path>& files) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with('.')) continue;
    if (entry.is_regular_file()) files.push_back(entry.path());
    // Not through links: they may lead round in circles.
    if (entry.is_directory() && !entry.is_symlink() && !is_result(entry.path())) list_files(entry.path(), files);
  }
}

void append(std::vector<fs::path>& to, const std::vector<fs::path>& paths) {
  to.insert(to.end(), paths.begin(), paths.end());
}

void add_folder(const fs::path& folder, BinLayout bin, ScanInputs& inputs) {
  std::vector<fs::path> files;
  try {
    list_files(folder, files);
  } catch (const fs::filesystem_error& e) {
    throw InputError(folder, "", "cannot be listed: " + e.code().message(), "check its permissions");
  }
  sort_naturally(files);
  const std::size_t before = inputs.scans.size();
  for (const auto& file : files) {
    try {
      const auto scans = scans_in(with_layout(file, bin));
      const ScanReader opened(scans.front(), ReadAttributes::kNo);  // notes.txt has the extension of a scan
      append(inputs.scans, scans);
    } catch (const InputError& e) {
      if (is_surely_scan(file)) throw;  // a scan must not get lost among the photos
      inputs.left_out.emplace_back(e.what());
    }
  }
  if (inputs.scans.size() == before) {
    throw InputError(folder, "", "is a folder without a scan",
                     inputs.left_out.empty() ? "name the files" : "the first file that is none: " + inputs.left_out[0]);
  }
}

bool has_wildcard(const std::string& text) { return text.find_first_of("*?[") != std::string::npos; }

std::vector<fs::path> matches_of(const std::string& pattern) {
  glob_t found{};
  const int failure = glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found);
  std::vector<fs::path> paths;
  for (std::size_t i = 0; failure == 0 && i < found.gl_pathc; ++i) paths.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  if (paths.empty()) throw InputError(pattern, "", "no file matches", "check the path");
  sort_naturally(paths);
  return paths;
}

void add_path(const fs::path& path, BinLayout bin, ScanInputs& inputs) {
  std::error_code unreachable;  // then reading says why
  if (fs::is_directory(path, unreachable)) return add_folder(path, bin, inputs);
  append(inputs.scans, scans_in(with_layout(path, bin)));
}

}  // namespace

fs::path with_layout(const fs::path& path, BinLayout bin) {
  if (bin == BinLayout::kNone || extension_of(path) != ".bin") return path;
  return path.string() + (bin == BinLayout::kKitti ? "#kitti" : "#nuscenes");
}

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view number_a = take_number(a), number_b = take_number(b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
      continue;
    }
    if (a[0] != b[0]) return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]);
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // 01 and 1
}

ScanInputs find_scans(const std::vector<std::string>& inputs, BinLayout bin) {
  ScanInputs found;
  for (const auto& input : inputs) {
    std::error_code ignored;
    if (has_wildcard(input) && !fs::exists(parse_scan_path(input).file, ignored)) {
      for (const auto& path : matches_of(input)) add_path(path, bin, found);
    } else {
      add_path(input, bin, found);
    }
  }
  return found;
}

}  // namespace tcm_icp
