#include "text_columns.hpp"

#include <algorithm>
#include <cctype>

#include "fields.hpp"

namespace tcm_icp {
namespace {

/// In lower case, without quotes and what stands in brackets.
std::string plain_word(std::string_view text) {
  std::string word;
  for (const char c : trimmed(text.substr(0, text.find_first_of("([")))) {
    if (c != '"') word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return word;
}

const std::array<std::vector<std::string_view>, 3> kWords{{{"easting", "east", "rechtswert"},
                                                           {"northing", "north", "hochwert"},
                                                           {"height", "elevation", "elev", "altitude", "hoehe"}}};
const std::array<std::vector<std::string_view>, 3> kLetters{{{"e"}, {"n"}, {"h", "z"}}};

std::size_t position(const std::vector<std::string>& words, const std::vector<std::string_view>& wanted) {
  const auto at = std::find_first_of(words.begin(), words.end(), wanted.begin(), wanted.end());
  return static_cast<std::size_t>(at - words.begin());
}

}  // namespace

std::optional<std::array<std::size_t, 3>> find_axes(const std::vector<std::string_view>& names) {
  std::vector<std::string> words;
  words.reserve(names.size());
  for (const auto name : names) words.push_back(plain_word(name));
  constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
  std::array<std::size_t, 3> columns{}, letters{};
  bool has_all = true, has_letters = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns[axis] = position(words, {kAxes[axis]});
    if (columns[axis] == words.size()) columns[axis] = position(words, kWords[axis]);
    letters[axis] = position(words, kLetters[axis]);
    has_all = has_all && columns[axis] < words.size();
    has_letters = has_letters && letters[axis] < words.size();
  }
  if (has_all) return columns;
  return has_letters ? std::optional(letters) : std::nullopt;  // single letters mean much, but not all three together
}

std::string colour_of(std::string_view name) {
  const std::string word = plain_word(name);
  for (const std::string_view colour : {"red", "green", "blue"}) {
    if (word == colour || word == colour.substr(0, 1)) return std::string(colour);
  }
  return {};
}

std::vector<std::string> pts_names(std::size_t num_columns) {
  if (num_columns == 4) return {"intensity"};
  if (num_columns == 6) return {"red", "green", "blue"};
  if (num_columns == 7) return {"intensity", "red", "green", "blue"};
  return {};
}

bool has_decimal_commas(std::string_view line) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::vector<std::string_view> fields;
  split_fields(line, ' ', fields);
  if (fields.size() < 3) return false;
  return std::all_of(fields.begin(), fields.end(), [&](std::string_view field) {
    const std::size_t at = field.find(',');
    if (at == std::string_view::npos) return true;
    return at > 0 && at + 1 < field.size() && is_digit(field[at - 1]) && is_digit(field[at + 1]) &&
           field.find(',', at + 1) == std::string_view::npos;
  });
}

bool has_commas_for_both(std::string_view text) {
  std::vector<std::string_view> fields;
  bool has_leading_zero = false;  // of a fraction: whole numbers are not written so
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    split_fields(line, ',', fields);
    if (end == std::string_view::npos) break;  // perhaps cut off
    if (fields.empty()) continue;
    if (fields.size() < 6 || fields.size() % 2 != 0) return false;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const bool is_fraction = i % 2 == 1;
      std::string_view digits = fields[i];
      if (!is_fraction && digits.starts_with('-')) digits.remove_prefix(1);
      if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) return false;
      if (digits.size() < 2 || digits.front() != '0') continue;
      if (!is_fraction) return false;
      has_leading_zero = true;
    }
  }
  return has_leading_zero;
}

}  // namespace tcm_icp
