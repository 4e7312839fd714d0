#include <cmath>
#include <numbers>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

Eigen::Vector3d vector_of(const Json& array) {
  Eigen::Vector3d v;
  for (int k = 0; k < 3; ++k) {
    const Json& entry = array.at(static_cast<std::size_t>(k));
    v[k] = entry.is_number() ? entry.get<double>() : std::nan("");
  }
  return v;
}

// Unit vector, its largest entry positive: a slide goes both ways.
std::string direction(Eigen::Vector3d v) {
  v.normalize();
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  if (v[largest] < 0) v = -v;
  std::string out;
  for (int k = 0; k < 3; ++k) {
    const double tenths = std::round(10 * v[k]);
    out += (k > 0 ? ", " : "(") + std::string(tenths < 0 ? "\u2212" : "") +
           (std::abs(tenths) == 10 ? "1.0" : "0." + std::to_string(static_cast<int>(std::abs(tenths))));
  }
  return out + ")";
}

// What moves a point more, at the distance that rotations count by.
std::string weakest_direction(const Json& strength) {
  const Json& axis = strength.at("axes").at(0);
  const Eigen::Vector3d shift_m = vector_of(axis.at("slide_translation_m"));
  const Eigen::Vector3d turn_deg = vector_of(axis.at("slide_rotation_deg"));
  if (!shift_m.allFinite() || !turn_deg.allFinite()) return "not held";
  const double arc_m = turn_deg.norm() * std::numbers::pi / 180 * strength.at("radius_m").get<double>();
  if (arc_m <= shift_m.norm()) return "along " + direction(shift_m);
  return figure(turn_deg.norm()) + "\u00B0 about " + direction(turn_deg);
}

}  // namespace

std::string links_section(const Json& report) {
  Rows rows;
  for (const auto& link : report.at("links")) {
    const Json& e = link.at("evidence");
    const bool accepted = link.at("verdict") == "accepted";
    const bool strength = link.contains("strength");
    rows.push_back({scan_label(report, link.at("a")), scan_label(report, link.at("b")),
                    badge(accepted ? "good" : "fair", escaped(link.at("verdict").get<std::string>())),
                    percent(e.at("overlap")), percent(e.at("inlier_share")), figure(e.at("median_residual_m"), 1000),
                    strength ? figure(link.at("strength").at("axes").at(0).at("slide_m"), 1000) : figure(Json()),
                    strength ? weakest_direction(link.at("strength")) : figure(Json()),
                    accepted ? "" : sentence(link.at("reason"))});
  }
  if (rows.empty()) return "";
  return section(
      "Links between scans that overlap",
      table({{"scan", "name"},
             {"scan", "name"},
             {"verdict", "text"},
             {"overlap", "number"},
             {"within<br/>noise", "number"},
             {"residual<br/>[mm]", "number"},
             {"can slide<br/>[mm]", "number"},
             {"in its weakest direction", "text"},
             {"reason", "wide"}},
            rows) +
          note(
              "Each pair is judged by its own points alone. One that is rejected does not prove itself, but may be "
              "right: the poses "
              "rest on all links. Can slide: how far one scan moves along the direction in which the two hold each "
              "other least until the points are off their surfaces by the noise; a rotation counts by the way of the "
              "points. Of a shift with a turn, what moves the points more is named, by its direction in x, y, z of the "
              "reference scan."));
}

}  // namespace tcm_icp::html
