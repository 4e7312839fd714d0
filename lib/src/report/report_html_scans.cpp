#include <algorithm>
#include <array>
#include <cstdio>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp::html {
namespace {

std::string swatch(std::size_t number) {
  const auto c = scan_colour(number);
  char text[96];
  std::snprintf(text, sizeof text, "<span class=\"swatch\" style=\"background: #%02x%02x%02x\"></span>", c[0], c[1],
                c[2]);
  return text;
}

std::string status(const Json& scan) {
  const auto status = scan.at("status").get<std::string>(), verdict = scan.at("verdict").get<std::string>();
  return (status == "unregistered" ? "not registered" : status) + "<br/>" +
         badge(verdict == "accepted"   ? "good"
               : verdict == "rejected" ? "bad"
                                       : "fair",
               verdict);
}

// The reference is where it is by definition: its standard deviations are 0, and say nothing.
std::string sigma(const Json& report, const Json& scan, const char* name, double factor) {
  const bool has_pose =
      scan.at("status") == "registered" || (scan.at("status") == "reference" && !in_frame_of_reference(report));
  if (!scan.contains("uncertainty") || scan.at("uncertainty").is_null() || !has_pose) return figure(Json());
  return norm(scan.at("uncertainty").at(name), factor);
}

}  // namespace

std::ptrdiff_t accepted_links(const Json& report, const Json& file) {
  const auto& links = report.at("links");
  return std::count_if(links.begin(), links.end(), [&](const auto& l) {
    return l.at("verdict") == "accepted" && (l.at("a") == file || l.at("b") == file);
  });
}

std::size_t scan_number(const Json& report, const Json& file) {
  const auto& scans = report.at("scans");
  const auto at = std::find_if(scans.begin(), scans.end(), [&](const auto& s) { return s.at("file") == file; });
  return static_cast<std::size_t>(at - scans.begin());
}

std::string scan_label(const Json& report, const Json& file) {
  return std::to_string(scan_number(report, file)) + "\u00A0" + file_name(file);
}

bool verifies(const Json& report) {
  return report.at("method") == "tcm" && report.at("options").at("profile") == "robust";
}

std::string scans_section(const Json& report) {
  Rows rows;
  const auto& scans = report.at("scans");
  const bool groups = std::any_of(scans.begin(), scans.end(), [](const auto& s) { return s.at("component") != 0; });
  for (const auto& scan : scans) {
    const Json evidence = scan.at("evidence").is_null() ? Json::object() : scan.at("evidence");
    rows.push_back({std::to_string(rows.size()), swatch(rows.size()) + file_name(scan.at("file")), status(scan),
                    passed(scan), percent(evidence.value("overlap", Json())),
                    percent(evidence.value("inlier_share", Json())),
                    figure(evidence.value("median_residual_m", Json()), 1000),
                    scan.value("residuals", Json()).is_null() ? "" : figure(scan.at("residuals").at("rms_m"), 1000),
                    sigma(report, scan, "sigma_position_m", 1000), sigma(report, scan, "sigma_rotation_deg", 1),
                    std::to_string(accepted_links(report, scan.at("file"))),
                    groups ? std::to_string(scan.at("component").get<int>()) : "", sentence(scan.at("reason"))});
  }
  return section(
      "Scans",
      table({{"no.", "number"},
             {"file", "name"},
             {"status,<br/>verdict", "text"},
             {"limits", "limits"},
             {"overlap", "number"},
             {"within<br/>noise", "number"},
             {"residual<br/>[mm]", "number"},
             {"RMS<br/>[mm]", "number"},
             {"1\u03C3 position<br/>[mm]", "number"},
             {"1\u03C3 rotation<br/>[\u00B0]", "number"},
             {"links", "number"},
             {"group", "number"},
             {"reason", "wide"}},
            rows) +
          note("The number is that of property <i>scan</i> in registered.ply, the colour that of its points where "
               "these have none of their own. "
               "Overlap: share of the scan\u2019s points, kept out of every fit, that have a neighbour in other scans; "
               "within noise: share of those that lie on the neighbour\u2019s surface; residual: median distance to "
               "it; RMS: of all its links, as in the table of links. 1\u03C3: standard deviation of the scan\u2019s "
               "middle and of its rotation against the reference "
               "scan, or in the survey frame, root of the sum over the axes. Links: accepted ones. Group 0 is the "
               "reference\u2019s; other groups have frames of their own."));
}

}  // namespace tcm_icp::html
