#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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
  const std::string by = length(axis.at("slide_m"));
  if (arc_m <= shift_m.norm()) return by + " along " + direction(shift_m);
  return by + ", a turn of " + figure(turn_deg.norm()) + "\u00B0 about " + direction(turn_deg);
}

std::string other_axes(const Json& strength) {
  std::string out;
  for (std::size_t k = 1; k < 6; ++k) {
    out += (out.empty() ? "" : ", ") + length(strength.at("axes").at(k).at("slide_m"));
  }
  return out;
}

// As high as a line of text: what a bell about 0 looks like, and what does not, shows at a glance.
std::string histogram(const Json& residuals) {
  if (residuals.is_null()) return "";
  const Json& counts = residuals.at("histogram").at("counts");
  long long most = 1;
  for (const auto& c : counts) most = std::max(most, c.get<long long>());
  std::string out = "<svg class=\"histogram small\" viewBox=\"0 0 " + std::to_string(3 * counts.size()) + " 26\">";
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const long long height = (24 * counts[k].get<long long>() + most - 1) / most;
    out += "<rect x=\"" + std::to_string(3 * k) + "\" y=\"" + std::to_string(25 - height) +
           "\" width=\"2.4\" height=\"" + std::to_string(height) + "\"/>";
  }
  return out + "<path d=\"M0 25.5 H" + std::to_string(3 * counts.size()) + "\"/></svg>";
}

std::string verdict_of(const Json& link) {
  const auto verdict = link.at("verdict").get<std::string>();
  return "<span title=\"" + sentence(link.at("reason")) + "\">" +
         badge(verdict == "accepted"   ? "good"
               : verdict == "rejected" ? "bad"
                                       : "fair",
               verdict) +
         "</span>";
}

}  // namespace

std::vector<std::size_t> links_worst_first(const Json& report) {
  const Json& links = report.at("links");
  const auto rms = [&](std::size_t k) {
    const Json& residuals = links[k].value("residuals", Json());
    return residuals.is_null() ? -1.0 : residuals.at("rms_m").get<double>();
  };
  std::vector<std::size_t> order(links.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rms(a) > rms(b); });
  return order;
}

std::string passed(const Json& of) {
  if (!of.contains("acceptance")) return "";
  std::string why;
  for (const auto& failure : of.at("acceptance").at("failures")) why += (why.empty() ? "" : "; ") + sentence(failure);
  return why.empty() ? badge("good", "pass") : "<span title=\"" + why + "\">" + badge("bad", "fail") + "</span>";
}

std::string links_section(const Json& report) {
  Rows rows;
  std::vector<std::string> attributes;
  for (const std::size_t k : links_worst_first(report)) {
    const Json& link = report.at("links").at(k);
    const Json& e = link.at("evidence");
    const Json residuals = link.value("residuals", Json());
    const auto of = [&](const char* name, double factor) {
      return residuals.is_null() ? figure(Json()) : figure(residuals.at(name), factor);
    };
    const bool strength = link.contains("strength");
    attributes.push_back(" data-link=\"" + std::to_string(k) + "\"");
    rows.push_back({scan_label(report, link.at("a")), scan_label(report, link.at("b")), verdict_of(link), passed(link),
                    percent(e.at("overlap")), of("rms_m", 1000), of("p95_m", 1000),
                    residuals.is_null() || residuals.at("share_within_limit").is_null()
                        ? ""
                        : percent(residuals.at("share_within_limit")),
                    histogram(residuals), strength ? weakest_direction(link.at("strength")) : figure(Json()),
                    strength ? other_axes(link.at("strength")) : ""});
  }
  if (rows.empty()) return "";
  const Json all = report.value("residuals", Json());
  const std::string ends = all.is_null()
                               ? ""
                               : " (\u00B1" +
                                     length(all.at("histogram").at("class_m").get<double>() *
                                            static_cast<double>(all.at("histogram").at("counts").size()) / 2) +
                                     ")";
  return section(
      "Links between scans that overlap, worst first",
      table({{"scan", "name"},
             {"scan", "name"},
             {"verdict", "text"},
             {"limits", "limits"},
             {"overlap", "number"},
             {"RMS<br/>[mm]", "number"},
             {"95\u202F%<br/>[mm]", "number"},
             {"within<br/>limit", "number"},
             {"residuals", "text"},
             {"can move unnoticed by", "text wrap"},
             {"in other directions", "text wrap"}},
            rows, attributes) +
          note("Residual: distance of a point of one scan from the surface of the other, along its normal; points are "
               "means of voxels of " +
               length(report.at("fine_voxel_m")) +
               ", and those farther than two voxels from the other scan are not compared. RMS: of "
               "those within three robust standard deviations, so that leaves and passers-by do not count; 95\u202F%: "
               "of all. "
               "The histogram has the signed "
               "residuals" +
               ends +
               ", what lies beyond in the outermost bars: a bell about 0 is good, two humps are a shift. Can move "
               "unnoticed: how far one scan moves in the "
               "direction in which the two hold each other least until its points are off their surfaces by the noise; "
               "a rotation counts by the way of the points; then the other five directions. Verdict: whether the pair "
               "by itself proves its pose. One that is doubtful or rejected may be right: poses rest on all links."));
}

}  // namespace tcm_icp::html
