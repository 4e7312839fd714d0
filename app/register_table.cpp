#include "register_table.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <ostream>
#include <string>

namespace tcm_icp::app {
namespace {

std::string text(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string percent(double share) { return text("%.0f %%", 100 * share); }

std::string right(const std::string& content, std::size_t width) {
  return std::string(width - std::min(width, content.size()), ' ') + content;
}

std::string left(const std::string& content, std::size_t width) {
  return content + std::string(width - std::min(width, content.size()), ' ');
}

std::string verdict_of(const ScanPose& pose) {
  if (pose.status == ScanStatus::kReference) return "reference";
  return pose.status == ScanStatus::kUnregistered ? "unregistered" : pose.verdict;
}

// Root of the sum over the three axes: how far off the scan's middle, and the scan's heading, may be.
std::string sigma(const PipelineResult& result, std::size_t scan, bool rotation) {
  if (result.uncertainty.poses.empty() || result.poses[scan].status != ScanStatus::kRegistered) return "";
  const PoseUncertainty& pose = result.uncertainty.poses[scan];
  if (!pose.determined) return "unknown";
  if (rotation) return text("%.2g", 180 / std::numbers::pi * pose.sigma_rotation_rad().norm());
  return text("%.2g", pose.sigma_position_m().norm());
}

}  // namespace

void print_register_table(const PipelineResult& result, std::ostream& out) {
  std::size_t width = 4;
  for (const auto& s : result.scans) width = std::max(width, s.file.size());
  out << left("scan", width) << "  verdict       overlap   agree  residual   +- pos  +- deg  reason\n";
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const ScanPose& pose = result.poses[i];
    const auto& evidence = result.evidence[i];
    std::string line = left(pose.file, width) + "  " + left(verdict_of(pose), 12);
    line += right(evidence ? percent(evidence->overlap) : "", 9);
    line += right(evidence ? percent(evidence->consensus()) : "", 8);
    line += right(evidence ? text("%.3g", evidence->median_residual_m) : "", 10);
    line += right(sigma(result, i, false), 9) + right(sigma(result, i, true), 8);
    if (pose.verdict != "accepted") line += "  " + pose.reason;
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
  for (const auto& [a, b] : result.adjustment.outlying_pairs) {
    out << result.scans[a].file << " and " << result.scans[b].file << " fit each other far worse than other pairs do\n";
  }
}

}  // namespace tcm_icp::app
