#include "plan_drawing.hpp"

#include <algorithm>
#include <cstdio>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp::html {
namespace {

template <typename... Values>
std::string print(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// An arc, so that links between scans in a row can be told apart.
std::string arc(const PlanGroup& group, const Json& report, const Json& a, const Json& b, const char* kind,
                double width) {
  constexpr double kBend = 0.25;  // height of the control point by the length
  const auto place = [&](const Json& file) {
    return std::find(group.scans.begin(), group.scans.end(), scan_number(report, file)) - group.scans.begin();
  };
  const auto i = place(a), j = place(b), n = static_cast<std::ptrdiff_t>(group.scans.size());
  if (i == n || j == n) return "";
  const Eigen::Vector2d p = group.layout.at[static_cast<std::size_t>(i)],
                        q = group.layout.at[static_cast<std::size_t>(j)];
  const Eigen::Vector2d along = q - p, control = p + along / 2 + kBend * Eigen::Vector2d(along.y(), -along.x());
  return print("<path class=\"link %s\" d=\"M%.1f %.1f Q%.1f %.1f %.1f %.1f\" stroke-width=\"%.1f\">", kind, p.x(),
               p.y(), control.x(), control.y(), q.x(), q.y(), width) +
         "<title>" + escaped(a.get<std::string>()) + " \u2013 " + escaped(b.get<std::string>()) + "</title></path>\n";
}

// What is least certain lies on top.
std::string arcs(const PlanGroup& group, const Json& report) {
  std::string good, fair, bad;
  for (const auto& l : report.at("links")) {
    const double width =
        0.8 + 3 * l.at("evidence").at("inlier_share").get<double>() * l.at("evidence").at("overlap").get<double>();
    const bool accepted = l.at("verdict") == "accepted";
    (accepted ? good : fair) +=
        arc(group, report, l.at("a"), l.at("b"), accepted ? "good" : "fair", accepted ? width : 1.2);
  }
  for (const Json* h : unused_links(report)) bad += arc(group, report, h->at("a"), h->at("b"), "bad", 2.4);
  for (const auto& pair : report.at("adjustment").at("outlying_links")) {
    bad += arc(group, report, pair.at(0), pair.at(1), "bad", 2.4);
  }
  if (report.contains("conventional")) {
    for (const auto& p : report.at("conventional").at("pairs")) {
      if (p.at("in_tree").get<bool>()) good += arc(group, report, p.at("source"), p.at("target"), "plain", 2);
    }
  }
  return good + fair + bad;
}

std::string discs(const PlanGroup& group, const Json& report) {
  std::string cover, out;
  for (std::size_t k = 0; k < group.scans.size(); ++k) {
    const Json& scan = report.at("scans")[group.scans[k]];
    const auto& p = group.layout.at[k];
    const auto c = scan_colour(group.scans[k]);
    const bool reference = scan.at("status") == "reference";
    if (group.background.empty())
      cover += print(
          "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#%02x%02x%02x\" stroke=\"#%02x%02x%02x\" "
          "class=\"cover\"/>\n",
          p.x(), p.y(), group.layout.scale * scan.at("extent_m").get<double>(), c[0], c[1], c[2], c[0], c[1], c[2]);
    // By the brightness the eye sees (ITU-R BT.601), so that the number can be read.
    const bool dark = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2] < 128;
    out += print(
               "<g><circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#%02x%02x%02x\" stroke=\"#1c2733\" "
               "stroke-width=\"%d\"/>",
               p.x(), p.y(), group.layout.disc, c[0], c[1], c[2], reference ? 3 : 1) +
           print("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" fill=\"%s\">%zu</text>", p.x(), p.y() + 4,
                 dark ? "#fff" : "#000", group.scans[k]) +
           "<title>" + escaped(scan.at("file").get<std::string>()) + "</title></g>\n";
  }
  return cover + arcs(group, report) + out;
}

std::string scale_bar(const PlanLayout& plan) {
  const double length_m = round_length(plan.width / 5 / plan.scale), to = 12 + plan.scale * length_m,
               y = plan.height - 10;
  return print(
             "<path d=\"M12 %.1f v6 H%.1f v-6\" fill=\"none\" stroke=\"#1c2733\"/>\n<text class=\"scale\" x=\"16\" "
             "y=\"%.1f\">",
             y - 4, to, y - 2) +
         print("%g m</text>\n", length_m);
}

}  // namespace

std::string plan_drawing(const PlanGroup& group, const Json& report) {
  const PlanLayout& plan = group.layout;
  return print("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" role=\"img\">\n", plan.width,
               plan.height) +
         "<title>Top view of group " + std::to_string(group.component) + "</title>\n" +
         print("<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fafbfc\"/>\n", plan.width, plan.height) +
         group.background + discs(group, report) + scale_bar(plan) + "</svg>\n";
}

}  // namespace tcm_icp::html
