#include "register_table.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <ostream>
#include <vector>

#include "figure.hpp"
#include "text_width.hpp"

namespace tcm_icp::app {
namespace {

constexpr double kMmPerM = 1000, kDegPerRad = 180 / std::numbers::pi;

std::string verdict_of(const ScanPose& pose) {
  if (pose.status == ScanStatus::kReference) return "reference";
  return std::string(pose.status == ScanStatus::kUnregistered ? to_string(pose.status) : to_string(pose.verdict));
}

// Nothing where the pose is not one of an adjustment; the reference is where it is by definition.
const PoseUncertainty* uncertainty_of(const PipelineResult& result, std::size_t scan) {
  if (result.uncertainty.poses.empty() || result.poses[scan].status == ScanStatus::kUnregistered) return nullptr;
  if (scan == result.reference && !result.survey.has_frame) return nullptr;
  return &result.uncertainty.poses[scan];
}

// Root of the sum over the three axes: how far off the scan's middle, and the scan's heading, may be.
double sigma_position_m(const PoseUncertainty& pose) { return pose.sigma_position_m().norm(); }
double sigma_rotation_rad(const PoseUncertainty& pose) { return pose.sigma_rotation_rad().norm(); }

struct Column {
  const char* name;
  const char* unit;
  std::size_t width;
};

// Between number and name on the left and nothing on the right; two spaces stand before each.
constexpr Column kColumns[] = {{"overlap", "[%]", 7},
                               {"agree", "[%]", 5},
                               {"residual", "[mm]", 8},
                               {"1 sigma", "[mm]", 7},
                               {"1 sigma", "[deg]", 7}};
constexpr std::size_t kNumberWidth = 3, kVerdictWidth = 12, kGap = 2;

std::size_t width_of_figures() {
  std::size_t width = kGap + kVerdictWidth;
  for (const Column& c : kColumns) width += kGap + c.width;
  return width;
}

std::size_t name_width(const PipelineResult& result, std::size_t width) {
  constexpr std::size_t kNarrowest = 9;  // three letters at either end
  const std::size_t taken = kNumberWidth + kGap + width_of_figures();
  std::size_t longest = 4;
  for (const auto& s : result.scans) longest = std::max(longest, num_characters(s.file));
  return std::min(longest, width > taken + kNarrowest ? width - taken : kNarrowest);
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

void print_header(std::size_t names, std::ostream& out) {
  const std::string gap(kGap, ' ');
  std::string name = right("no.", kNumberWidth) + gap + left("scan", names) + gap + left("verdict", kVerdictWidth);
  std::string unit(num_characters(name), ' ');
  for (const Column& c : kColumns) {
    name += gap + right(c.name, c.width);
    unit += gap + right(c.unit, c.width);
  }
  out << name << '\n' << unit << '\n';
}

std::vector<std::string> figures(const PipelineResult& result, std::size_t scan) {
  std::vector<std::string> cells(std::size(kColumns));
  if (const auto& evidence = result.evidence[scan]) {
    cells[0] = figure("%.0f", 100 * evidence->overlap);
    cells[1] = figure("%.0f", 100 * evidence->consensus());
    cells[2] = figure("%.3g", kMmPerM * evidence->median_residual_m);
  }
  if (const PoseUncertainty* pose = uncertainty_of(result, scan)) {
    const double sigma_mm = kMmPerM * sigma_position_m(*pose);
    cells[3] = pose->determined ? figure(sigma_mm < 100 ? "%.2g" : "%.0f", sigma_mm) : "unknown";
    cells[4] = pose->determined ? figure("%.2g", kDegPerRad * sigma_rotation_rad(*pose)) : "unknown";
  }
  return cells;
}

std::string worst_sigma(const PipelineResult& result) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const PoseUncertainty* pose = uncertainty_of(result, i);
    if (pose == nullptr) continue;
    if (!pose->determined) return ", worst 1 sigma unknown (" + result.poses[i].file + ")";
    if (!worst || sigma_position_m(*pose) > sigma_position_m(result.uncertainty.poses[*worst])) worst = i;
  }
  if (!worst) return "";
  const double sigma_mm = kMmPerM * sigma_position_m(result.uncertainty.poses[*worst]);
  const std::string length =
      sigma_mm < kMmPerM ? figure("%.2g", sigma_mm) + " mm" : figure("%.3g", sigma_mm / kMmPerM) + " m";
  return ", worst 1 sigma " + length + " (" + result.poses[*worst].file + ")";
}

}  // namespace

void print_register_table(const PipelineResult& result, std::size_t width, std::ostream& out) {
  const std::size_t names = name_width(result, width);
  const std::string gap(kGap, ' ');
  print_header(names, out);
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const ScanPose& pose = result.poses[i];
    std::string line = right(std::to_string(i), kNumberWidth) + gap + left(shortened(pose.file, names), names) + gap +
                       left(verdict_of(pose), kVerdictWidth);
    const auto cells = figures(result, i);
    for (std::size_t c = 0; c < cells.size(); ++c) line += gap + right(cells[c], kColumns[c].width);
    out << without_trailing_spaces(line) << '\n';
    if (pose.verdict != Verdict::kAccepted) out << wrapped(pose.reason, width, kNumberWidth + kGap);
  }
  for (const auto& [a, b] : result.adjustment.outlying_pairs) {
    out << wrapped(
        result.scans[a].file + " and " + result.scans[b].file + " fit each other far worse than other pairs do", width,
        0);
  }
}

std::string register_summary(const PipelineResult& result, bool verified, const std::filesystem::path& report) {
  const auto placed = std::count_if(result.poses.begin(), result.poses.end(),
                                    [](const ScanPose& p) { return p.status != ScanStatus::kUnregistered; });
  return std::to_string(placed) + " of " + std::to_string(result.poses.size()) +
         (verified ? " registered" : " have a pose, none verified") + worst_sigma(result) + ", open " + report.string();
}

}  // namespace tcm_icp::app
