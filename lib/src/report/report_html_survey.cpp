#include <string>

#include <cmath>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

std::string status_badge(const Json& point) {
  const auto status = point.at("status").get<std::string>();
  return badge(status == "used" ? "good" : status == "blunder" ? "bad" : status == "check" ? "plain" : "fair", status);
}

std::string entry(const Json& vector, std::size_t axis) {
  return vector.is_null() ? figure(Json()) : figure(vector.at(axis), 1000);
}

// Root mean square distance of the points of a status from where they were given.
std::string rms_of(const Json& survey, const char* status) {
  double squares = 0;
  int n = 0;
  for (const auto& p : survey.at("points")) {
    if (p.at("status").get<std::string>() != status || p.at("residual_m").is_null()) continue;
    for (const auto& d : p.at("residual_m")) squares += d.is_number() ? std::pow(d.get<double>(), 2) : 0;
    ++n;
  }
  return n == 0 ? "none" : length(Json(std::sqrt(squares / n))) + ", " + std::to_string(n) + " observed";
}

}  // namespace

bool in_frame_of_reference(const Json& report) {
  const Json survey = report.value("survey", Json());
  return survey.is_null() || survey.at("has_frame") == false;
}

std::string survey_section(const Json& report) {
  const Json survey = report.value("survey", Json());
  if (survey.is_null()) return "";
  std::string content;
  for (const auto& remark : survey.at("remarks")) content += "<p>" + sentence(remark) + "</p>\n";
  const Json& crs = survey.at("crs");
  content += facts(
      {{"frame defined by", survey.at("has_frame") == true ? sentence(survey.at("defined_by")) : "the reference scan"},
       {"coordinate system", crs.is_null() ? "not told" : escaped(crs.get_ref<const std::string&>())},
       {"rotations determined", count(survey.at("rotations_determined")) + " of 3"},
       {"control points off by (RMS)", rms_of(survey, "used")},
       {"check points off by (RMS)", rms_of(survey, "check")},
       {"redundant observations", count(survey.at("degrees_of_freedom"))},
       {"variance factor", figure(survey.at("variance_factor"))},
       {"scans moved among each other by at most", figure(survey.at("largest_change_m"), 1000) + " mm"}});
  Rows rows;
  for (const auto& p : survey.at("points")) {
    std::vector<std::string> row{file_name(p.at("name")), file_name(p.at("scan")), status_badge(p)};
    for (const char* const name : {"residual_m", "sigma_m"}) {
      for (std::size_t axis = 0; axis < 3; ++axis) row.push_back(entry(p.at(name), axis));
    }
    row.push_back(figure(p.at("redundancy")));
    row.push_back(figure(p.at("test")));
    rows.push_back(std::move(row));
  }
  content += table({{"point", "name"},
                    {"scan", "name"},
                    {"status", "text"},
                    {"dX<br/>[mm]", "number"},
                    {"dY<br/>[mm]", "number"},
                    {"dZ<br/>[mm]", "number"},
                    {"1\u03C3 X<br/>[mm]", "number"},
                    {"1\u03C3 Y<br/>[mm]", "number"},
                    {"1\u03C3 Z<br/>[mm]", "number"},
                    {"redun-<br/>dancy", "number"},
                    {"test", "number"}},
                   rows);
  return section("Survey frame",
                 content + note("d: computed less given coordinates, and the standard deviation they should have. "
                                "Redundancy: how much of the three coordinates the others check. Test: squared "
                                "normalised residual; it exceeds 16.3 once in a thousand times where nothing is wrong. "
                                "Blunders and check points had no part in the adjustment."));
}

}  // namespace tcm_icp::html
