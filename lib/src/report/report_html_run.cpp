#include <algorithm>
#include <cstdio>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

struct Bar {
  std::string name;
  double seconds = 0, peak_memory_mb = 0;
};

// Stages that come once for each group are one bar.
std::vector<Bar> bars(const Json& report) {
  std::vector<Bar> bars;
  for (const auto& stage : report.at("stages")) {
    const auto name = stage.at("name").get<std::string>();
    auto bar = std::find_if(bars.begin(), bars.end(), [&](const Bar& b) { return b.name == name; });
    if (bar == bars.end()) bar = bars.insert(bars.end(), Bar{name, 0, 0});
    bar->seconds += stage.at("seconds").get<double>();
    bar->peak_memory_mb = std::max(bar->peak_memory_mb, stage.at("peak_memory_mb").get<double>());
  }
  return bars;
}

std::string bar_chart(const std::vector<Bar>& bars) {
  constexpr double kNames = 130, kBars = 360, kRow = 20;
  double longest = 0;
  for (const auto& bar : bars) longest = std::max(longest, bar.seconds);
  char text[200];
  std::snprintf(text, sizeof text, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 %.0f\" role=\"img\">\n",
                kRow * static_cast<double>(bars.size()));
  std::string out = std::string(text) + "<title>Time of each stage</title>\n";
  double y = 0;
  for (const auto& bar : bars) {
    const double length = longest > 0 ? kBars * bar.seconds / longest : 0;
    std::snprintf(
        text, sizeof text,
        "<rect x=\"%.0f\" y=\"%.0f\" width=\"%.1f\" height=\"14\" fill=\"#4878a8\"/>\n<text x=\"0\" y=\"%.0f\">",
        kNames, y + 3, length, y + 14);
    out += text + escaped(bar.name) + "</text>";
    std::snprintf(text, sizeof text, "<text x=\"%.1f\" y=\"%.0f\">", kNames + length + 6, y + 14);
    out += text + figure(bar.seconds) + " s, up to " + figure(bar.peak_memory_mb) + " MiB</text>\n";
    y += kRow;
  }
  return out + "</svg>\n";
}

std::string value_text(const Json& value) {
  if (value.is_string())
    return value.get_ref<const std::string&>().empty() ? "chosen" : escaped(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.is_number_integer() ? count(value) : figure(value);
}

std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return escaped(key);
}

}  // namespace

std::string measured_section(const Json& report) {
  Rows rows;
  for (const auto& scan : report.at("scans")) {
    rows.push_back({scan_label(report, scan.at("file")), count(scan.at("points")), count(scan.at("dropped_points")),
                    count(scan.at("working_points")), count(scan.at("outliers").at("working_points_removed")),
                    figure(scan.at("working_voxel_m"), 1000), figure(scan.at("spacing_m"), 1000),
                    figure(scan.at("noise_m"), 1000), figure(scan.at("extent_m"))});
  }
  return section(
      "Measured from the scans",
      facts({{"voxels that scans were placed with", figure(report.at("coarse_voxel_m"), 1000) + " mm"},
             {"voxels they were adjusted with", figure(report.at("fine_voxel_m"), 1000) + " mm"}}) +
          table({{"scan", "name"},
                 {"points", "number"},
                 {"not finite", "number"},
                 {"sample", "number"},
                 {"outliers<br/>in it", "number"},
                 {"its voxels<br/>[mm]", "number"},
                 {"spacing<br/>[mm]", "number"},
                 {"noise<br/>[mm]", "number"},
                 {"extent<br/>[m]", "number"}},
                rows) +
          note("Spacing: median distance of a point of the sample to its neighbour; noise: median deviation from the "
               "local "
               "plane; extent: radius that holds nine tenths of the points. Lengths are given as if the unit of the "
               "scans were the metre."));
}

std::string stages_section(const Json& report) {
  return section("Time and memory", "<figure class=\"bars\">\n" + bar_chart(bars(report)) + "</figure>\n");
}

std::string options_section(const Json& report) {
  std::vector<std::pair<std::string, std::string>> pairs{{"method", escaped(report.at("method").get<std::string>())}};
  for (const auto& [key, value] : report.at("options").items()) pairs.emplace_back(words(key), value_text(value));
  Rows sums;
  for (const auto& scan : report.at("scans")) {
    if (scan.contains("sha256")) {
      sums.push_back({scan_label(report, scan.at("file")),
                      "<span class=\"sum\">" + escaped(scan.at("sha256").get<std::string>()) + "</span>"});
    }
  }
  const Json& initial = report.at("initial_poses");
  pairs.emplace_back("initial poses", initial.is_null() ? "none" : file_name(initial));
  return section(
      "Command and options",
      "<code>" + escaped(report.at("command_line").get<std::string>()) + "</code>\n" + facts(pairs) +
          (sums.empty() ? "" : table({{"input", "name"}, {"SHA-256 of its file", "wide"}}, sums)) +
          note("All figures of this page, and more, are in report.json beside it; docs/formats.md explains them."));
}

std::string signature_section() {
  std::string out = "<div class=\"signatures\">\n";
  for (const char* role : {"Prepared by", "Checked by"}) {
    out += "<div>\n<h3>" + std::string(role) + "</h3>\n";
    for (const char* line : {"Name", "Date", "Signature"}) out += "<p>" + std::string(line) + "<i></i></p>\n";
    out += "</div>\n";
  }
  return section("Signatures", out + "</div>\n");
}

}  // namespace tcm_icp::html
