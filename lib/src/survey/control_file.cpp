#include "tcm_icp/survey/control_file.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "survey/csv_table.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
namespace {

constexpr const char* kAnyScan = "*";

/// Three columns, or one that serves for all axes.
using Columns = std::array<std::size_t, 3>;

Columns given_columns(const CsvTable& table) {
  return {table.column({"X", "E", "Easting", "East"}), table.column({"Y", "N", "Northing", "North"}),
          table.column({"Z", "H", "Height", "Elevation"})};
}

Columns sigma_columns(const CsvTable& table) {
  if (const auto one = table.find({"sigma"})) return {*one, *one, *one};
  if (!table.find({"sigma_X", "sigma_E"})) table.column({"sigma"});  // refuses by the name most will want
  return {table.column({"sigma_X", "sigma_E"}), table.column({"sigma_Y", "sigma_N"}),
          table.column({"sigma_Z", "sigma_H"})};
}

Eigen::Vector3d numbers(const CsvTable& table, const CsvRow& row, const Columns& columns) {
  return {table.number(row, columns[0]), table.number(row, columns[1]), table.number(row, columns[2])};
}

Eigen::Vector3d sigmas(const CsvTable& table, const CsvRow& row, const Columns& columns, double least) {
  const Eigen::Vector3d sigma = numbers(table, row, columns);
  if (least > 0 ? (sigma.array() > 0).all() : (sigma.array() >= 0).all()) return sigma;
  table.refuse(row, std::string("a standard deviation is ") + (least > 0 ? "not above 0" : "below 0"),
               "give it as a length, 0.003 for 3 mm where the unit is the metre");
}

/// Names of scans as results have them, or as they stand on the command line.
class ScanNames {
 public:
  explicit ScanNames(const std::vector<std::filesystem::path>& scans) : scans_(scans), names_(scan_names(scans)) {}

  std::size_t find(const CsvTable& table, const CsvRow& row, const std::string& name) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (name == names_[i] || name == scans_[i]) return i;
    }
    std::vector<std::size_t> in_file;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (name == parse_scan_path(scans_[i]).file) in_file.push_back(i);
    }
    if (in_file.size() == 1) return in_file.front();
    table.refuse(row, "names '" + name + "', which is not among the scans",
                 "name it as results do, such as " + names_.front() + (has_any_ ? ", or * for none" : ""));
  }
  void allow_any() { has_any_ = true; }
  const std::string& name(std::size_t i) const { return names_[i]; }
  double metres(std::size_t i) const { return metres_in(parse_scan_path(scans_[i]).unit); }

 private:
  const std::vector<std::filesystem::path>& scans_;
  std::vector<std::string> names_;
  bool has_any_ = false;
};

PointUse use_of(const CsvTable& table, const CsvRow& row, const std::optional<std::size_t>& column) {
  const std::string text = column ? row.cells[*column] : "";
  if (text.empty() || text == "control") return PointUse::kControl;
  if (text == "check") return PointUse::kCheck;
  table.refuse(row, "has the use '" + text + "'", "choose control or check");
}

}  // namespace

std::vector<ControlPoint> read_control_file(const std::filesystem::path& path,
                                            const std::vector<std::filesystem::path>& scans) {
  const CsvTable table(path);
  ScanNames names(scans);
  names.allow_any();
  const std::size_t name = table.column({"name"}), scan = table.column({"scan"});
  const Columns measured{table.column({"x"}), table.column({"y"}), table.column({"z"})};
  const Columns given = given_columns(table), sigma = sigma_columns(table);
  const auto sigma_scan = table.find({"sigma_scan"}), use = table.find({"use"});
  std::vector<ControlPoint> points;
  std::map<std::string, std::size_t> first_lines;  // of each name
  std::set<std::pair<std::string, std::string>> seen;
  for (const CsvRow& row : table.rows()) {
    ControlPoint p;
    p.name = row.cells[name];
    if (p.name.empty()) table.refuse(row, "has no name", "name the point: reports do so");
    p.measured = numbers(table, row, measured);
    if (row.cells[scan] != kAnyScan) {
      const std::size_t i = names.find(table, row, row.cells[scan]);
      p.scan = names.name(i);
      p.measured *= names.metres(i);
    }
    p.given = numbers(table, row, given);
    p.sigma_given_m = sigmas(table, row, sigma, 1);
    if (sigma_scan && !row.cells[*sigma_scan].empty()) {
      p.sigma_measured_m = sigmas(table, row, {*sigma_scan, *sigma_scan, *sigma_scan}, 0);
    } else {
      p.sigma_given_m *= std::numbers::sqrt2 / 2;
      p.sigma_measured_m.setConstant(p.sigma_given_m.norm() / std::numbers::sqrt3);
    }
    p.use = use_of(table, row, use);
    if (!seen.emplace(p.name, p.scan).second) {
      table.refuse(row, "measures the point " + p.name + " a second time in one scan", "leave one of the two out");
    }
    const auto [first, is_new] = first_lines.emplace(p.name, points.size());
    if (!is_new && points[first->second].given != p.given) {
      table.refuse(row, "gives the point " + p.name + " another place than an earlier line",
                   "give each point a name of its own");
    }
    points.push_back(std::move(p));
  }
  if (points.empty()) table.refuse("holds no point", "give a line for each");
  return points;
}

std::vector<ControlPoint> read_scanner_positions(const std::filesystem::path& path,
                                                 const std::vector<std::filesystem::path>& scans) {
  const CsvTable table(path);
  const ScanNames names(scans);
  const std::size_t scan = table.column({"scan"});
  const Columns given = given_columns(table), sigma = sigma_columns(table);
  std::optional<Columns> place;
  if (table.find({"x"})) place = Columns{table.column({"x"}), table.column({"y"}), table.column({"z"})};
  std::vector<ControlPoint> points;
  std::set<std::string> seen;
  for (const CsvRow& row : table.rows()) {
    ControlPoint p;
    const std::size_t i = names.find(table, row, row.cells[scan]);
    p.name = p.scan = names.name(i);
    p.is_scanner = true;
    if (place) p.measured = names.metres(i) * numbers(table, row, *place);
    p.given = numbers(table, row, given);
    p.sigma_given_m = sigmas(table, row, sigma, 1);
    if (!seen.insert(p.scan).second) table.refuse(row, "names " + p.scan + " a second time", "leave one of them out");
    points.push_back(std::move(p));
  }
  if (points.empty()) table.refuse("holds no position", "give a line for each scan whose place is known");
  return points;
}

}  // namespace tcm_icp
