#include "survey/csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <utility>

#include "io/fields.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string place(std::size_t line) { return "line " + std::to_string(line); }

}  // namespace

CsvTable::CsvTable(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  if (std::filesystem::is_directory(path_, error)) refuse("is a folder", "name the file in it");
  std::ifstream in(path_, std::ios::binary);
  if (!in) refuse("cannot be opened", "check the path and the permissions");
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    const std::string text(trimmed(line, kBlanks));
    if (text.empty() || text.front() == '#') continue;
    if (names_.empty()) {
      separator_ = text.find(';') != std::string::npos ? ';' : ',';
      names_ = split(text, number);
      for (auto name = names_.begin(); name != names_.end(); ++name) {
        if (std::find(names_.begin(), name, *name) == name) continue;
        throw InputError(path_, place(number), "names the column '" + *name + "' twice", "leave one of the two out");
      }
      continue;
    }
    rows_.push_back({number, split(text, number)});
    if (rows_.back().cells.size() == names_.size()) continue;
    refuse(rows_.back(),
           "has " + std::to_string(rows_.back().cells.size()) + " values, not the " + std::to_string(names_.size()) +
               " that the line of names has",
           "mend it there; the separator is '" + std::string(1, separator_) + "'");
  }
  if (names_.empty()) refuse("holds no line of names", "docs/formats.md has an example");
}

std::vector<std::string> CsvTable::split(const std::string& line, std::size_t number) const {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"') {
      const bool doubled = quoted && k + 1 < line.size() && line[k + 1] == '"';
      if (doubled) {
        cells.back() += line[++k];
      } else {
        quoted = !quoted;
      }
    } else if (c == separator_ && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted) throw InputError(path_, place(number), "has a quote that does not end", "mend it there");
  for (auto& cell : cells) cell = std::string(trimmed(cell, kBlanks));
  return cells;
}

std::optional<std::size_t> CsvTable::find(const std::vector<std::string>& names) const {
  for (const auto& name : names) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at != names_.end()) return static_cast<std::size_t>(at - names_.begin());
  }
  return std::nullopt;
}

std::size_t CsvTable::column(const std::vector<std::string>& names) const {
  if (const auto at = find(names)) return *at;
  std::string all;
  for (const auto& name : names_) all += (all.empty() ? "" : ", ") + name;
  refuse("has no column '" + names.front() + "' (its columns are " + all + ")",
         "name it in the first line; docs/formats.md has an example");
}

double CsvTable::number(const CsvRow& row, std::size_t column) const {
  const std::string& cell = row.cells[column];
  const char* const begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
  const char* const end = cell.data() + cell.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error == std::errc() && rest == end && std::isfinite(value)) return value;
  refuse(row, "'" + cell + "' in the column " + names_[column] + " is no number",
         "write it with a decimal point and without a unit");
}

void CsvTable::refuse(const CsvRow& row, const std::string& problem, const std::string& remedy) const {
  throw InputError(path_, place(row.line), problem, remedy);
}

void CsvTable::refuse(const std::string& problem, const std::string& remedy) const {
  throw InputError(path_, "", problem, remedy);
}

}  // namespace tcm_icp
