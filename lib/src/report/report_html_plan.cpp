#include <algorithm>
#include <cmath>

#include "plan_drawing.hpp"
#include "report/base64.hpp"
#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

// A scan stands at its scanner, where that is known, else at the middle of its points.
Eigen::Vector2d place_of(const Json& scan) {
  const Json pose = scan.value("pose", Json());
  const Json& at = !pose.is_null() && pose.at("is_setup") == true ? pose.at("position_m") : scan.at("middle_m");
  return {at.at(0).get<double>(), at.at(1).get<double>()};
}

bool any_setup(const Json& report) {
  const auto& scans = report.at("scans");
  return std::any_of(scans.begin(), scans.end(), [](const Json& scan) {
    const Json pose = scan.value("pose", Json());
    return !pose.is_null() && pose.at("is_setup") == true;
  });
}

// Scans that are registered share a frame, even where control points alone tie them to the others.
int frame_of(const Json& scan) { return scan.at("status") == "unregistered" ? scan.at("component").get<int>() : 0; }

std::vector<PlanGroup> groups_of(const Json& report) {
  std::vector<PlanGroup> groups;
  const auto& scans = report.at("scans");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].at("middle_m").is_null()) continue;
    const int component = frame_of(scans[i]);
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const PlanGroup& g) { return g.component == component; });
    if (group == groups.end()) group = groups.insert(groups.end(), PlanGroup{component, {}, {}, {}});
    group->scans.push_back(i);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const PlanGroup& a, const PlanGroup& b) { return a.component < b.component; });
  for (auto& group : groups) {
    std::vector<Eigen::Vector2d> middles;
    std::vector<double> extents_m;
    for (const std::size_t i : group.scans) {
      middles.push_back(place_of(scans[i]));
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
         key("fair", "doubtful or rejected link: by itself it does not prove the pose") +
         key("bad", "contradicts the poses");
}

// How many points lie above one another in each pixel, from paper to ink: walls are dark.
std::string density(const PlanGroup& group, const Scene& scene) {
  const PlanLayout& plan = group.layout;
  constexpr double kPixels = 1.5;  // by unit of the drawing
  const int width = static_cast<int>(kPixels * plan.width), height = static_cast<int>(kPixels * plan.height);
  std::vector<int> counts(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const double scale = kPixels * plan.scale;
  for (const std::size_t i : group.scans) {
    if (scene.scans.empty()) break;  // nothing was written that points could be taken from
    const SceneScan& scan = scene.scans[i];
    for (const auto& point : scan.points) {
      const Eigen::Vector3d p = scan.T_view_scan * point.cast<double>() + scene.groups[scan.group].origin;
      const int x = static_cast<int>(std::floor(width / 2.0 + scale * (p.x() - plan.centre_m.x())));
      const int y = static_cast<int>(std::floor(height / 2.0 - scale * (p.y() - plan.centre_m.y())));
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      ++counts[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
  }
  std::vector<int> occupied;
  for (const int n : counts) {
    if (n > 0) occupied.push_back(n);
  }
  if (occupied.empty()) return "";
  const auto most = occupied.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(occupied.size() - 1));
  std::nth_element(occupied.begin(), most, occupied.end());
  Image image(width, height, {250, 251, 252});
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    const double ink = 0.18 + 0.72 * std::min(1.0, std::log1p(counts[k]) / std::log1p(*most));
    image.pixels[k] = {static_cast<std::uint8_t>(250 - ink * 205), static_cast<std::uint8_t>(251 - ink * 190),
                       static_cast<std::uint8_t>(252 - ink * 170)};
  }
  const std::string bytes = png(image);
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return "<image width=\"" + std::to_string(static_cast<int>(plan.width)) + "\" height=\"" +
         std::to_string(static_cast<int>(plan.height)) +
         "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," + base64({data, bytes.size()}) + "\"/>\n";
}

}  // namespace

std::string plan_section(const Json& report, const Scene& scene) {
  std::string figures;
  for (auto& group : groups_of(report)) {
    if (group.scans.size() < 2) continue;
    group.background = density(group, scene);
    const Json& scans = report.at("scans");
    const auto first = std::find_if(group.scans.begin(), group.scans.end(),
                                    [&](std::size_t i) { return scans[i].at("status") == "reference"; });
    // In the figure: what is printed keeps both on one page.
    figures += "<figure>\n" + (figures.empty() ? "<p class=\"legend\">\n" + legend(report) + "</p>\n" : std::string()) +
               plan_drawing(group, report) + "<figcaption>Group " + std::to_string(group.component) +
               (group.component != 0             ? ", not registered with the others, in a frame of its own"
                : !in_frame_of_reference(report) ? ", in the survey frame"
                : first == group.scans.end()     ? ""
                                             : ", in the frame of " + scan_label(report, scans[*first].at("file"))) +
               ", seen along its z axis: x to the right, y up. " +
               (group.layout.moved ? "Discs that would cover one another are moved apart." : "") +
               "</figcaption>\n</figure>\n";
  }
  if (figures.empty()) return "";
  return section(
      "Plan",
      figures +
          note(std::string(any_setup(report)
                               ? "A disc stands where its scan was taken from, or where that cannot be told "
                                 "at the median of its points"
                               : "A disc stands at the median of its scan\u2019s points") +
               (scene.num_points() > 0 ? "; grey: density of the points seen from above. "
                                       : "; the faint circle is as large as what holds nine tenths of its points. ") +
               "The reference scan has a thick rim. Scans without a place are not drawn."));
}

}  // namespace tcm_icp::html
