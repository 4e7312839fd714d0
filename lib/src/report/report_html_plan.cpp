#include <algorithm>

#include "plan_drawing.hpp"
#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

std::vector<PlanGroup> groups_of(const Json& report) {
  std::vector<PlanGroup> groups;
  const auto& scans = report.at("scans");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].at("middle_m").is_null()) continue;
    const int component = scans[i].at("component").get<int>();
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const PlanGroup& g) { return g.component == component; });
    if (group == groups.end()) group = groups.insert(groups.end(), PlanGroup{component, {}, {}});
    group->scans.push_back(i);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const PlanGroup& a, const PlanGroup& b) { return a.component < b.component; });
  for (auto& group : groups) {
    std::vector<Eigen::Vector2d> middles;
    std::vector<double> extents_m;
    for (const std::size_t i : group.scans) {
      const Json& middle = scans[i].at("middle_m");
      middles.emplace_back(middle.at(0).get<double>(), middle.at(1).get<double>());
      extents_m.push_back(scans[i].at("extent_m").get<double>());
    }
    group.layout = lay_out_plan(middles, extents_m);
  }
  return groups;
}

std::string key(const char* kind, const char* text) {
  return "<span class=\"key\"><svg viewBox=\"0 0 34 8\"><path class=\"link " + std::string(kind) +
         "\" d=\"M2 4 H32\" stroke-width=\"2\"/></svg>" + text + "</span>\n";
}

std::string legend(const Json& report) {
  if (report.contains("conventional")) return key("plain", "pair that the poses follow");
  return key("good", "accepted link; thicker: more points agree") +
         key("fair", "rejected link: overlap that proves nothing by itself") + key("bad", "contradicts the poses");
}

}  // namespace

std::string plan_section(const Json& report) {
  std::string figures;
  for (const auto& group : groups_of(report)) {
    if (group.scans.size() < 2) continue;
    const Json& scans = report.at("scans");
    const auto first = std::find_if(group.scans.begin(), group.scans.end(),
                                    [&](std::size_t i) { return scans[i].at("status") == "reference"; });
    figures += "<figure>\n" + plan_drawing(group, report) + "<figcaption>Group " + std::to_string(group.component) +
               (first == group.scans.end() ? ", in a frame of its own"
                                           : ", in the frame of " + scan_label(report, scans[*first].at("file"))) +
               ", seen along its z axis: x to the right, y up. " +
               (group.layout.moved ? "Discs that would cover one another are moved apart." : "") +
               "</figcaption>\n</figure>\n";
  }
  if (figures.empty()) return "";
  return section(
      "Plan",
      "<p class=\"legend\">\n" + legend(report) + "</p>\n" + figures +
          note("A disc stands at the median of its scan\u2019s points; the faint circle holds nine tenths of them. The "
               "reference scan has a thick rim. Scans without a place are not drawn."));
}

}  // namespace tcm_icp::html
