#include "pcd_header.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "fields.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMaxPointSize = InputBuffer::kMaxLine;  // [bytes] what one look at the buffer can show
constexpr std::size_t kMostNumbers = 4096;                    // of a point; the longest descriptors have some 2000

class Parser {
 public:
  explicit Parser(InputBuffer& input) : input_(input) {}

  PcdHeader parse() {
    while (!parse_line()) continue;
    if (!has_fields_) fail("ends a header without a line 'FIELDS'");
    if (!has_sizes_) fail("ends a header without a line 'SIZE'");
    if (!has_kinds_) fail("ends a header without a line 'TYPE'");
    for (PcdField& field : header_.fields) check(field);
    if (header_.point_size == 0) fail("ends a header without any field");
    set_number();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(input_.path(), "header line " + std::to_string(input_.line_number()), problem,
                     "write the file again with another program");
  }

  std::uint64_t count_of(std::string_view text) const {
    std::uint64_t count = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || rest != text.data() + text.size()) fail(quoted(text) + " is not a count");
    return count;
  }

  /// A value for each field.
  template <typename Set>
  void for_each_field(const Set& set) {
    if (!has_fields_) fail("stands before the line 'FIELDS'");
    if (words_.size() - 1 != header_.fields.size()) {
      fail("has " + std::to_string(words_.size() - 1) + " values for " + std::to_string(header_.fields.size()) +
           " fields");
    }
    for (std::size_t i = 0; i < header_.fields.size(); ++i) set(header_.fields[i], words_[i + 1]);
  }

  std::uint64_t single_count() const {
    if (words_.size() != 2) fail("is not one number");
    return count_of(words_[1]);
  }

  /// True for the last line of the header.
  bool parse_line() {
    std::string_view line;
    if (!input_.next_line(line)) fail("is the last line, but the header has no 'DATA'");
    if (input_.offset() > InputBuffer::kMaxLine) fail("is past 1 MiB, but the header has no 'DATA' yet");
    split_fields(line, ' ', words_);
    if (words_.empty() || words_[0].starts_with('#')) return false;
    const std::string_view key = words_[0];
    if (key == "VERSION" || key == "VIEWPOINT") return false;
    if (key == "FIELDS" || key == "COLUMNS") {
      set_fields();
    } else if (key == "SIZE") {
      for_each_field([this](PcdField& f, std::string_view word) { f.size = count_of(word); });
      has_sizes_ = true;
    } else if (key == "TYPE") {
      for_each_field([](PcdField& f, std::string_view word) { f.kind = word.size() == 1 ? word[0] : '?'; });
      has_kinds_ = true;
    } else if (key == "COUNT") {
      for_each_field([this](PcdField& f, std::string_view word) { f.count = count_of(word); });
    } else if (key == "WIDTH") {
      width_ = single_count();
    } else if (key == "HEIGHT") {
      height_ = single_count();
    } else if (key == "POINTS") {
      points_ = single_count();
    } else if (key == "DATA") {
      set_data();
      return true;
    } else {
      fail("begins with " + quoted(key) + ", which PCD does not know");
    }
    return false;
  }

  void set_fields() {
    if (has_fields_) fail("is a second line 'FIELDS'");
    for (std::size_t i = 1; i < words_.size(); ++i) {
      header_.fields.emplace_back();
      header_.fields.back().name = words_[i];
    }
    has_fields_ = true;
  }

  void set_data() {
    const std::string_view data = words_.size() == 2 ? words_[1] : std::string_view();
    if (data == "ascii") {
      header_.data = PcdData::kAscii;
    } else if (data == "binary") {
      header_.data = PcdData::kBinary;
    } else if (data == "binary_compressed") {
      header_.data = PcdData::kBinaryCompressed;
    } else {
      fail("is not 'DATA ascii', 'DATA binary' or 'DATA binary_compressed'");
    }
  }

  void check(PcdField& field) {
    const std::size_t size = field.size;
    const bool is_float = field.kind == 'F' && (size == 4 || size == 8);
    const bool is_integer =
        (field.kind == 'I' || field.kind == 'U') && (size == 1 || size == 2 || size == 4 || size == 8);
    // Padding may have any size.
    if (!is_float && !is_integer && (field.name != "_" || size > kMaxPointSize)) {
      fail("ends a header whose field " + quoted(std::string_view(field.name)) + " is of no known type");
    }
    if (field.count == 0) field.count = 1;  // what old versions of PCL wrote
    if (field.count > kMaxPointSize || header_.point_size + size * field.count > kMaxPointSize) {
      fail("ends a header whose points have more than 1 MiB each");
    }
    field.offset = header_.point_size;
    header_.point_size += size * field.count;
    if (field.name != "_") num_numbers_ += field.count;
    if (num_numbers_ > kMostNumbers) fail("ends a header whose points have more than 4096 numbers each");
  }

  void set_number() {
    if (!points_ && !width_) fail("ends a header without the number of points");
    const std::uint64_t height = height_.value_or(1), width = width_.value_or(0);
    if (width_ && height != 0 && width > UINT64_MAX / height) fail("ends a header with more points than can be");
    header_.num_points = points_.value_or(width * height);
    if (width_ && header_.num_points != width * height) {
      fail("ends a header with " + std::to_string(header_.num_points) + " points, but " + std::to_string(width) +
           " x " + std::to_string(height) + " of them");
    }
  }

  InputBuffer& input_;
  PcdHeader header_;
  std::vector<std::string_view> words_;
  std::optional<std::uint64_t> width_, height_, points_;
  std::size_t num_numbers_ = 0;  ///< of a point, without padding
  bool has_fields_ = false, has_sizes_ = false, has_kinds_ = false;
};

}  // namespace

PcdHeader read_pcd_header(InputBuffer& input) { return Parser(input).parse(); }

}  // namespace tcm_icp
