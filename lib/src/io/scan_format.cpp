#include "scan_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

#include "fields.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kHead = 4096;  // [bytes] more than the first lines of any scan, less than a page of the disk

constexpr std::array<std::pair<std::string_view, ScanFormat>, 11> kExtensions{{{".ply", ScanFormat::kPly},
                                                                               {".las", ScanFormat::kLas},
                                                                               {".laz", ScanFormat::kLas},
                                                                               {".pcd", ScanFormat::kPcd},
                                                                               {".e57", ScanFormat::kE57},
                                                                               {".ptx", ScanFormat::kPtx},
                                                                               {".xyz", ScanFormat::kText},
                                                                               {".txt", ScanFormat::kText},
                                                                               {".asc", ScanFormat::kText},
                                                                               {".pts", ScanFormat::kText},
                                                                               {".csv", ScanFormat::kText}}};

std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return trimmed(line);
}

/// One whole number on each of two lines, three numbers on each of four, four on each of four: what no list of points
/// begins with.
bool begins_like_ptx(std::string_view text) {
  std::vector<std::string_view> fields;
  for (const std::size_t count : {1, 1, 3, 3, 3, 3, 4, 4, 4, 4}) {
    split_fields(next_line(text), ' ', fields);
    if (fields.size() != count) return false;
    if (count == 1 && fields[0].find_first_not_of("0123456789") != std::string_view::npos) return false;
  }
  return true;
}

bool begins_like_pcd(std::string_view text) {
  return text.starts_with("# .PCD") || text.starts_with("VERSION .7") || text.starts_with("VERSION 0.7") ||
         text.starts_with("VERSION .6") || text.starts_with("VERSION 0.6");
}

bool begins_like_ply(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text.starts_with("ply\n") || text.starts_with("ply\r");
}

/// What is told of files that are no scan, but are often taken for one.
struct NoScan {
  std::string_view begins, problem, remedy;
};
constexpr const char* kUnpack = "unpack it, and name the scans in it";
constexpr std::array<NoScan, 9> kNoScans{
    {{"PK\x03\x04", "is a zip archive", kUnpack},
     {"7z\xBC\xAF\x27\x1C", "is a 7z archive", kUnpack},
     {"Rar!", "is a RAR archive", kUnpack},
     {"BZh", "is packed by bzip2", kUnpack},
     {"\xFD"
      "7zXZ",
      "is packed by xz", kUnpack},
     {"\x28\xB5\x2F\xFD", "is packed by zstd", kUnpack},
     {"version https://git-lfs", "only points to the data (Git LFS)", "fetch them: git lfs pull"},
     {"<!DOCTYPE html", "is a web page", "download the scan again: the page may say what went wrong"},
     {"<html", "is a web page", "download the scan again: the page may say what went wrong"}}};

void refuse_what_is_no_scan(const InputBuffer& input, std::string_view head) {
  for (const auto& [begins, problem, remedy] : kNoScans) {
    if (head.starts_with(begins)) throw InputError(input.path(), "", std::string(problem), std::string(remedy));
  }
}

/// Formats of scanners' own programs, which nobody else reads.
bool belongs_to_a_scanner(std::string_view extension) {
  constexpr std::array<std::string_view, 14> kOwn{".fls", ".fws",  ".lsproj", ".rcp", ".rcs", ".zfs", ".zfprj",
                                                  ".rxp", ".rdbx", ".imp",    ".lgs", ".cl3", ".dp",  ".pcap"};
  return std::find(kOwn.begin(), kOwn.end(), extension) != kOwn.end();
}

}  // namespace

std::string extension_of(const std::filesystem::path& path) {
  const auto lower_extension = [](const std::filesystem::path& name) {
    std::string extension = name.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
  };
  const std::string extension = lower_extension(path);
  return extension == ".gz" ? lower_extension(path.stem()) : extension;
}

ScanFormat format_of(InputBuffer& input) {
  const std::string_view head = input.head(kHead);
  if (begins_like_ply(head)) return ScanFormat::kPly;
  if (head.starts_with("LASF")) return ScanFormat::kLas;
  if (head.starts_with("ASTM-E57")) return ScanFormat::kE57;
  if (begins_like_pcd(head)) return ScanFormat::kPcd;
  refuse_what_is_no_scan(input, head);
  const std::string extension = extension_of(input.path());
  for (const auto& [known, format] : kExtensions) {
    if (extension != known) continue;
    return format == ScanFormat::kText && begins_like_ptx(head) ? ScanFormat::kPtx : format;
  }
  if (extension == ".bin") {
    throw InputError(input.path(), "", "may hold anything", "say what it is: --bin kitti or --bin nuscenes");
  }
  if (belongs_to_a_scanner(extension)) {
    throw InputError(input.path(), "", "is of a scanner's own format ('" + extension + "')",
                     "export the scans as E57, PTX or LAS from the program it belongs to");
  }
  throw InputError(input.path(), "",
                   "is of no known format: neither its first bytes nor its extension '" + extension + "' tell",
                   "scans are read from PLY, LAS, E57, PCD, PTX, PTS and text (.xyz .txt .asc .csv); convert it to one "
                   "of them");
}

bool is_surely_scan(const std::filesystem::path& file) {
  try {
    InputBuffer input(file);
    if (format_of(input) != ScanFormat::kText) return true;
  } catch (const InputError&) {
    // empty, or of an unknown format: its name has the say
  }
  const std::string extension = extension_of(file);
  for (const char* const scan : {".ply", ".las", ".laz", ".pcd", ".e57", ".ptx", ".pts", ".xyz"}) {
    if (extension == scan) return true;
  }
  return false;
}

}  // namespace tcm_icp
