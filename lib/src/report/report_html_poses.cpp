#include <cmath>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

std::string fixed(const Json& value, int digits) {
  if (!value.is_number()) return figure(Json());
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, value.get<double>());
  return text[0] == '-' ? "\u2212" + std::string(text + 1) : text;
}

// Millimetres of metres, and the same share of smaller scenes.
int decimals(const Json& report) {
  const double voxel_m = report.at("fine_voxel_m").get<double>();
  return voxel_m > 0 && voxel_m < 0.01 ? 5 : 3;
}

bool has_sigma(const Json& report, const Json& scan) {
  const bool has_pose =
      scan.at("status") == "registered" || (scan.at("status") == "reference" && !in_frame_of_reference(report));
  return has_pose && scan.contains("uncertainty") && !scan.at("uncertainty").is_null();
}

}  // namespace

std::string poses_section(const Json& report) {
  Rows rows;
  for (const auto& scan : report.at("scans")) {
    const Json pose = scan.value("pose", Json());
    if (pose.is_null()) continue;
    std::vector<std::string> row{scan_label(report, scan.at("file"))};
    for (std::size_t k = 0; k < 3; ++k) row.push_back(fixed(pose.at("position_m").at(k), decimals(report)));
    row.push_back(pose.at("is_setup") == true ? "set-up" : "file's origin");
    row.push_back(fixed(pose.at("heading_deg"), 3));
    row.push_back(fixed(pose.at("tilt_deg"), 3));
    const bool known = has_sigma(report, scan);
    for (std::size_t k = 0; k < 3; ++k) {
      row.push_back(known ? figure(scan.at("uncertainty").at("sigma_position_m").at(k), 1000) : figure(Json()));
    }
    row.push_back(known ? norm(scan.at("uncertainty").at("sigma_rotation_deg")) : figure(Json()));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  return section(
      "Poses",
      table({{"scan", "name"},
             {"X [m]", "number"},
             {"Y [m]", "number"},
             {"Z [m]", "number"},
             {"of the", "text"},
             {"heading<br/>[\u00B0]", "number"},
             {"tilt<br/>[\u00B0]", "number"},
             {"1\u03C3 X<br/>[mm]", "number"},
             {"1\u03C3 Y<br/>[mm]", "number"},
             {"1\u03C3 Z<br/>[mm]", "number"},
             {"1\u03C3 turn<br/>[\u00B0]", "number"}},
            rows) +
          note(
              "Where each scan lies in the common frame. X, Y, Z are those of its scanner, found from the points "
              "themselves (set-up), or where that cannot be told those of the origin of the file\u2019s coordinates. "
              "Heading: by how much the scan\u2019s x axis is turned about the vertical, anticlockwise seen from "
              "above; "
              "tilt: angle between its z axis and that of the frame. 1\u03C3: standard deviation of the middle of the "
              "scan\u2019s points against the reference scan or the survey frame. poses.json has the matrices with all "
              "their digits."));
}

}  // namespace tcm_icp::html
