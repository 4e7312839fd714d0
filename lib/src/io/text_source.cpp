#include "text_source.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "attribute_names.hpp"
#include "fields.hpp"
#include "scalar.hpp"
#include "scan_format.hpp"
#include "tcm_icp/core/error.hpp"
#include "text_columns.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kLook = std::size_t{1} << 16U;  // [bytes] looked at ahead, to tell what columns are

/// The delimiter of a line: a semicolon before a comma, because with decimal commas both stand in it.
char delimiter_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  return line.find(',') != std::string_view::npos && !has_decimal_commas(line) ? ',' : ' ';
}

std::size_t comment_prefix(std::string_view line) {
  if (line.starts_with('#')) return line.find_first_not_of('#');
  return line.starts_with("//") ? 2 : 0;
}

/// True for a record, damaged or not: so that 1,5 is told to be no number instead of no header.
bool begins_like_a_number(std::string_view line) {
  const std::string_view token = line.substr(0, line.find_first_of(" \t,;"));
  return line.find_first_of("+-.0123456789") == 0 || parse_number(token).has_value();
}

}  // namespace

TextSource::TextSource(InputBuffer input, CloudIs cloud) : input_(std::move(input)), cloud_(cloud) {
  const std::byte* const bom = input_.peek(3);
  if (bom && std::memcmp(bom, "\xEF\xBB\xBF", 3) == 0) input_.consume(3);
  read_start();
  name_attributes();
}

void TextSource::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(input_.path(), input_.line_place(), problem, remedy);
}

void TextSource::read_start() {
  std::string_view line;
  while (input_.next_line(line)) {
    line = trimmed(line);
    if (line.empty() || take_header(line) || take_count(line)) continue;
    return take_first_record(line);
  }
  check_count();
}

/// A line of names, or a comment; false for a line of numbers.
bool TextSource::take_header(std::string_view line) {
  const std::size_t prefix = comment_prefix(line);
  if (prefix == std::string_view::npos) return true;
  split_fields(line.substr(prefix), delimiter_of(line), fields_);
  if (prefix == 0 && begins_like_a_number(line)) return false;
  const auto axes = find_axes(fields_);
  if (axes && header_.empty()) {
    for (const auto field : fields_) {
      const std::string colour = colour_of(field);
      header_.push_back(colour.empty() ? attribute_name(field) : colour);
    }
    axis_columns_ = *axes;
    header_is_comment_ = prefix != 0;
  } else if (prefix == 0) {
    fail("begins with " + quoted(line.substr(0, line.find_first_of(" \t,;"))) +
             ", which is neither a number nor a header",
         "a header names the columns x, y and z, or easting, northing and height; put # before a comment");
  }
  return true;
}

/// A whole number alone on a line before the points is their count.
bool TextSource::take_count(std::string_view line) {
  std::uint64_t count = 0;
  if (!is_count_line(line, count)) return false;
  if (promised_) fail("is a second count line", "remove it");
  promised_ = count;
  return true;
}

void TextSource::take_first_record(std::string_view line) {
  delimiter_ = delimiter_of(line);
  split_fields(line, delimiter_, fields_);
  if (fields_.size() < 3) {
    fail("has " + std::to_string(fields_.size()) + " columns, but a point has x, y and z",
         "separate columns by blanks, tabs, commas or semicolons");
  }
  constexpr std::size_t kMostColumns = 4096;
  if (fields_.size() > kMostColumns) {
    fail("has " + std::to_string(fields_.size()) + " columns; at most 4096 are read", "this may be no list of points");
  }
  if (header_is_comment_ && header_.size() != fields_.size()) {  // "# x y z are in metres" is no header after all
    header_.clear();
    axis_columns_ = {0, 1, 2};
  }
  if (!header_.empty() && header_.size() != fields_.size()) {
    fail("has " + std::to_string(fields_.size()) + " columns, but the header names " + std::to_string(header_.size()),
         "make them agree, or remove the header");
  }
  num_columns_ = fields_.size();
  parse_record(line);
  has_pending_ = true;
  if (delimiter_ == ',' && header_.empty()) refuse_commas_for_both(line);
}

void TextSource::refuse_commas_for_both(std::string_view first_line) {
  std::string text(first_line);  // gone once more is looked at
  text += '\n';
  text += input_.head(kLook);
  if (!has_commas_for_both(text)) return;
  fail("has commas between columns and, as it seems, within numbers: 1,5 cannot be told from 1 and 5",
       "export it with decimal points, or with semicolons between columns");
}

void TextSource::name_attributes() {
  const std::size_t count = num_columns_ > 0 ? num_columns_ : header_.size();
  if (header_.empty() && extension_of(input_.path()) == ".pts") {
    const std::vector<std::string> usual = pts_names(count);
    if (!usual.empty()) header_ = {"x", "y", "z"};
    header_.insert(header_.end(), usual.begin(), usual.end());
  }
  for (std::size_t column = 0; column < count; ++column) {
    if (std::find(axis_columns_.begin(), axis_columns_.end(), column) != axis_columns_.end()) continue;
    std::string name = unique_name(header_.empty() ? std::string() : header_[column],
                                   "column_" + std::to_string(column + 1), attributes_);
    attributes_.push_back({std::move(name), ScalarType::kFloat64});
    attribute_columns_.push_back(column);
  }
  find_byte_colours();
}

/// Colours are bytes where all of the first points have whole numbers from 0 to 255, and not all just 0 and 1.
void TextSource::find_byte_colours() {
  std::vector<std::size_t> colours;
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    const std::string& name = attributes_[i].name;
    if (name == "red" || name == "green" || name == "blue") colours.push_back(i);
  }
  if (colours.size() != 3 || !has_pending_) return;
  double highest = 0;
  const auto look = [&](double value) {
    highest = std::max(highest, value);
    return fits(value, ScalarType::kUInt8);
  };
  for (const std::size_t i : colours) {
    if (!look(values_[attribute_columns_[i]])) return;
  }
  std::string_view text = input_.head(kLook);
  std::vector<std::string_view> fields;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    split_fields(text.substr(0, end), delimiter_, fields);
    text.remove_prefix(end + 1);
    if (fields.size() < num_columns_) continue;
    for (const std::size_t i : colours) {
      const auto value = parse_number(fields[attribute_columns_[i]]);
      if (value && !look(*value)) return;  // what is no number is told when its turn comes
    }
  }
  if (highest <= 1) return;
  for (const std::size_t i : colours) attributes_[i].type = ScalarType::kUInt8;
}

bool TextSource::next_content_line(std::string_view& line) {
  while (input_.next_line(line)) {
    line = trimmed(line);
    if (!line.empty() && comment_prefix(line) == 0) return true;
  }
  return false;
}

/// Where all promised points are there, another count begins another cloud.
bool TextSource::begins_next_cloud(std::string_view line) const {
  std::uint64_t count = 0;
  if (!promised_ || num_read_ != *promised_ || !is_count_line(line, count)) return false;
  if (cloud_ == CloudIs::kAll) refuse_several(input_);
  return true;
}

void TextSource::parse_record(std::string_view line) {
  split_fields(line, delimiter_, fields_);
  if (fields_.size() != num_columns_) {
    fail("has " + std::to_string(fields_.size()) + " columns, but the first point has " + std::to_string(num_columns_),
         "the file is damaged or truncated: write or copy it again");
  }
  values_.resize(num_columns_);
  for (std::size_t column = 0; column < num_columns_; ++column) {
    const auto value = parse_field(fields_[column]);
    if (!value) {
      fail("column " + std::to_string(column + 1) + " holds " + quoted(fields_[column]) + ", which is not a number",
           "mend the line, or put # before it");
    }
    values_[column] = *value;
  }
}

/// A number, with a decimal comma where the file has those: which of the two, its first number with either decides.
std::optional<double> TextSource::parse_field(std::string_view field) {
  if (decimal_ == '.') {
    const auto value = parse_number(field);
    if (value || field.find(',') == std::string_view::npos) return value;
  }
  const std::size_t at = field.find_first_of(".,");
  if (at == std::string_view::npos || field.find('#') != std::string_view::npos) return parse_number(field);  // 1.#INF
  if (decimal_ != '\0' && field[at] != decimal_) {
    fail(quoted(field) + " is written with a decimal " + (decimal_ == '.' ? "comma" : "point") +
             ", but numbers before it with a " + (decimal_ == '.' ? "point" : "comma"),
         "write all numbers in one way");
  }
  decimal_ = field[at];
  if (decimal_ == '.') return parse_number(field);
  number_ = field;
  number_[at] = '.';
  return parse_number(number_);
}

bool TextSource::next(Eigen::Vector3d& point, std::byte* attributes) {
  if (!std::exchange(has_pending_, false)) {
    std::string_view line;
    if (is_finished_ || !next_content_line(line) || begins_next_cloud(line)) {
      is_finished_ = true;
      check_count();
      return false;
    }
    parse_record(line);
  }
  ++num_read_;
  if (promised_ && num_read_ > *promised_) check_count();
  for (int axis = 0; axis < 3; ++axis) point[axis] = values_[axis_columns_[static_cast<std::size_t>(axis)]];
  check_colours();
  if (!attributes) return true;
  for (std::size_t i = 0; i < attribute_columns_.size(); ++i) {
    store_scalar(values_[attribute_columns_[i]], attributes_[i].type, attributes);
    attributes += scalar_size(attributes_[i].type);
  }
  return true;
}

void TextSource::check_colours() const {
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    if (attributes_[i].type != ScalarType::kUInt8) continue;
    const double value = values_[attribute_columns_[i]];
    if (!fits(value, ScalarType::kUInt8)) {
      fail("the " + attributes_[i].name + " of a point is no whole number from 0 to 255, as those before are",
           "name the columns of colours otherwise, as R16");
    }
  }
}

void TextSource::check_count() const {
  if (!promised_ || num_read_ == *promised_) return;
  fail((num_read_ < *promised_ ? "ends after " + std::to_string(num_read_) + " points"
                               : std::string("is one point more")) +
           ", but the count line promises " + std::to_string(*promised_),
       "write or copy the file again, or remove the count line");
}

}  // namespace tcm_icp
