#include "tcm_icp/io/scan_path.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <system_error>
#include <utility>

#include "open_scan.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

/// The last `count` parts of a path.
std::string tail(const fs::path& path, std::size_t count) {
  std::vector<fs::path> parts(path.begin(), path.end());
  fs::path out;
  for (std::size_t i = parts.size() - std::min(count, parts.size()); i < parts.size(); ++i) out /= parts[i];
  return out.generic_string();
}

/// Without the root, "." and "..": what may stand in a name.
fs::path plain(const fs::path& path) {
  std::error_code error;
  fs::path absolute = fs::absolute(path, error);
  return (error ? path : absolute).lexically_normal().relative_path();
}

/// Splits "hall.e57#2" into file and "2"; no word where there is none, or where a file has the whole name.
std::pair<fs::path, std::string> take_word(const fs::path& path) {
  std::error_code ignored;
  const std::string text = path.string();
  const std::size_t mark = text.rfind('#');
  if (mark == std::string::npos || fs::exists(path, ignored)) return {path, ""};
  return {text.substr(0, mark), text.substr(mark + 1)};
}

fs::path path_of(const ScanPath& scan) {
  std::string text = scan.file.string();
  if (scan.number > 0) text.append("#").append(std::to_string(scan.number));
  if (scan.bin == BinLayout::kKitti) text += "#kitti";
  if (scan.bin == BinLayout::kNuScenes) text += "#nuscenes";
  if (scan.unit != LengthUnit::kMetre) text.append("#").append(name_of(scan.unit));
  return text;
}

}  // namespace

ScanPath parse_scan_path(const fs::path& path) {
  ScanPath scan{path};
  const auto unit = unit_from_name(take_word(scan.file).second);
  if (unit && *unit != LengthUnit::kMetre) {
    scan.file = take_word(scan.file).first;
    scan.unit = *unit;
  }
  const auto [file, word] = take_word(scan.file);
  std::size_t number = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  if (word == "kitti") {
    scan.bin = BinLayout::kKitti;
  } else if (word == "nuscenes") {
    scan.bin = BinLayout::kNuScenes;
  } else if (error == std::errc() && rest == end && number > 0) {
    scan.number = number;
  } else {
    return scan;
  }
  scan.file = file;
  return scan;
}

fs::path with_unit(const fs::path& path, LengthUnit unit) {
  ScanPath scan = parse_scan_path(path);
  scan.unit = unit;
  return path_of(scan);
}

std::vector<fs::path> scans_in(const fs::path& path) {
  const ScanPath scan = parse_scan_path(path);
  if (scan.number > 0 || scan.bin != BinLayout::kNone) return {path};
  const std::size_t count = count_scans(scan.file);
  if (count == 1) return {path};
  std::vector<fs::path> scans;
  for (std::size_t i = 1; i <= count; ++i) scans.push_back(path_of({scan.file, i, scan.bin, scan.unit}));
  return scans;
}

std::vector<std::string> scan_names(const std::vector<fs::path>& scans) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::size_t>> by_name;
  std::vector<fs::path> paths;
  for (const auto& scan : scans) {
    const ScanPath parsed = parse_scan_path(scan);
    paths.push_back(path_of({parsed.file, parsed.number}));
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    names.push_back(paths[i].filename().string());
    by_name[names.back()].push_back(i);
  }
  for (const auto& [name, twins] : by_name) {
    std::map<std::string, std::size_t> longer;
    for (std::size_t length = 2; twins.size() > 1 && longer.size() < twins.size(); ++length) {
      longer.clear();
      std::size_t longest = 0;
      for (const std::size_t i : twins) {
        const fs::path path = plain(paths[i]);
        longer.emplace(tail(path, length), i);
        longest = std::max<std::size_t>(longest, static_cast<std::size_t>(std::distance(path.begin(), path.end())));
      }
      if (length > longest) break;  // named twice: nothing tells them apart
    }
    if (longer.size() == twins.size()) {
      for (const auto& [text, i] : longer) names[i] = text;
    }
  }
  return names;
}

}  // namespace tcm_icp
