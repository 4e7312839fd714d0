#include "degradation_report.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tcm_icp/core/error.hpp"
#include "version.hpp"

namespace tcm_icp::app {
namespace {

using Json = nlohmann::ordered_json;

std::string verb(const std::string& kind) {
  return kind == "occlusion" ? "hidden" : kind == "removal" ? "removed" : kind == "noise" ? "moved" : "added";
}

void print_step(const DegradationStep& s, std::ostream& out) {
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(), "  %-9s  %8zu points %s", s.kind.c_str(), s.changed, verb(s.kind).c_str());
  out << line.data();
  if (s.length_m > 0) {
    std::snprintf(line.data(), line.size(), ", %s %.4g", s.kind == "isolated" ? "no nearer than" : "sigma", s.length_m);
    out << line.data();
  }
  out << '\n';
}

Json to_json(const DegradedFile& file) {
  Json steps = Json::array();
  for (const auto& s : file.steps) {
    steps.push_back({{"kind", s.kind},
                     {"share", s.share},
                     {"points_before", s.points_before},
                     {"points_after", s.points_after},
                     {"changed", s.changed},
                     {"length_m", s.length_m}});
  }
  return {{"file", file.name},
          {"points_before", file.points_before},
          {"points_after", file.points_after},
          {"steps", steps}};
}

}  // namespace

void print_degradation(const DegradationReport& report, std::ostream& out) {
  for (const auto& file : report.files) {
    out << file.name << "  " << file.points_before << " -> " << file.points_after << " points\n";
    for (const auto& step : file.steps) print_step(step, out);
  }
}

void write_degradation(const DegradationReport& report, const std::filesystem::path& path) {
  Json scans = Json::array();
  for (const auto& file : report.files) scans.push_back(to_json(file));
  const Json json{{"schema", 1},         {"program", "tcm-icp"},
                  {"version", kVersion}, {"command_line", report.command_line},
                  {"seed", report.seed}, {"scans", scans}};
  std::ofstream out(path, std::ios::binary);
  out << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
  out.close();
  if (!out) throw OutputError(path, "cannot be written", "check the folder, its permissions and free space");
}

}  // namespace tcm_icp::app
