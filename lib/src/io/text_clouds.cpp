#include "text_clouds.hpp"

#include <charconv>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include "fields.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

/// A file as it was when it was walked through.
struct FileState {
  std::filesystem::path path;
  std::uintmax_t size = 0;
  std::filesystem::file_time_type changed;
  bool operator<(const FileState& other) const {
    return std::tie(path, size, changed) < std::tie(other.path, other.size, other.changed);
  }
};

FileState state_of(const std::filesystem::path& path) {
  std::error_code ignored;  // then the state never matches again, and the file is walked through once more
  return {std::filesystem::weakly_canonical(path, ignored), std::filesystem::file_size(path, ignored),
          std::filesystem::last_write_time(path, ignored)};
}

/// Lines of points: not blank, and no comment.
bool next_content(InputBuffer& input, std::string_view& line) {
  while (input.next_line(line)) {
    line = trimmed(line);
    if (!line.empty() && line.front() != '#' && !line.starts_with("//")) return true;
  }
  return false;
}

bool skip_content(InputBuffer& input, std::uint64_t count) {
  std::string_view line;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!next_content(input, line)) return false;
  }
  return true;
}

/// Goes on to the next line of points without taking it. Its place.
std::optional<CloudStart> next_start(InputBuffer& input) {
  for (;;) {
    const std::string_view head = input.head(1);
    if (head.empty()) return std::nullopt;
    if (head[0] != '\n' && head[0] != '\r' && head[0] != ' ' && head[0] != '\t') break;
    std::string_view line;
    if (head[0] == '\n') {
      input.next_line(line);
    } else {
      input.consume(1);
    }
  }
  return CloudStart{input.offset(), input.line_number()};
}

/// Takes one cloud; false where the file ends in it, or is not what is expected.
bool skip_cloud(InputBuffer& input, ScanFormat format) {
  constexpr std::uint64_t kPtxHeaderLines = 8;  // position, three axes, 4 x 4
  std::string_view line;
  std::uint64_t columns = 0, rows = 0;
  if (!next_content(input, line) || !is_count_line(line, columns)) return false;
  if (format == ScanFormat::kText) return skip_content(input, columns);
  if (!next_content(input, line) || !is_count_line(line, rows)) return false;
  if (rows != 0 && columns > input.size().value_or(UINT64_MAX) / rows) return false;  // a cell has bytes
  return skip_content(input, kPtxHeaderLines) && skip_content(input, columns * rows);
}

std::vector<CloudStart> walk_through(const std::filesystem::path& path, ScanFormat format) {
  std::vector<CloudStart> starts{{}};
  InputBuffer input(path);
  if (input.head(3) == "\xEF\xBB\xBF") input.consume(3);
  while (skip_cloud(input, format)) {
    const auto next = next_start(input);
    std::string_view line = next ? input.head(20) : std::string_view();
    line = trimmed(line.substr(0, line.find_first_of("\r\n")));
    std::uint64_t count = 0;
    if (!is_count_line(line, count)) break;
    starts.push_back(*next);
  }
  return starts;
}

}  // namespace

bool is_count_line(std::string_view line, std::uint64_t& count) {
  const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), count);
  return error == std::errc() && rest == line.data() + line.size();
}

void refuse_several(const InputBuffer& input) {
  throw InputError(input.path(), input.line_place(), "begins a second scan",
                   "name one of them, as " + input.path().filename().string() + "#1");
}

std::vector<CloudStart> find_clouds(const std::filesystem::path& path, ScanFormat format) {
  static std::mutex guard;
  static std::map<FileState, std::vector<CloudStart>> known;
  const FileState state = state_of(path);
  {
    const std::lock_guard<std::mutex> lock(guard);
    const auto at = known.find(state);
    if (at != known.end()) return at->second;
  }
  std::vector<CloudStart> starts = walk_through(path, format);
  const std::lock_guard<std::mutex> lock(guard);
  return known.emplace(state, std::move(starts)).first->second;
}

}  // namespace tcm_icp
