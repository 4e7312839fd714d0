#pragma once
// Tables of comma or semicolon separated values with a line of names.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tcm_icp {

struct CsvRow {
  std::size_t line = 0;  ///< in the file, from 1
  std::vector<std::string> cells;
};

class CsvTable {
 public:
  /// Blank lines and those that begin with # are passed over; quotes as in RFC 4180, without line feeds in them. The
  /// names decide the separator: semicolon where there is one, else comma.
  /// @throws InputError  it cannot be opened, has no names, a line with another number of cells, a name twice
  explicit CsvTable(std::filesystem::path path);

  const std::vector<CsvRow>& rows() const { return rows_; }

  /// The column of the first of these names that is there. Case counts: x is not X.
  std::optional<std::size_t> find(const std::vector<std::string>& names) const;
  /// @throws InputError  naming names.front()
  std::size_t column(const std::vector<std::string>& names) const;

  /// @throws InputError  where the cell is no finite number
  double number(const CsvRow& row, std::size_t column) const;

  [[noreturn]] void refuse(const CsvRow& row, const std::string& problem, const std::string& remedy) const;
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;

 private:
  std::vector<std::string> split(const std::string& line, std::size_t number) const;

  std::filesystem::path path_;
  char separator_ = ',';
  std::vector<std::string> names_;
  std::vector<CsvRow> rows_;
};

}  // namespace tcm_icp
