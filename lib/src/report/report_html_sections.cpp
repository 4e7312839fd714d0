#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plan_layout.hpp"
#include "report/section_cut.hpp"
#include "report_html_parts.hpp"
#include "report_html_text.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp::html {
namespace {

constexpr int kWidth = 1100;

template <typename... Values>
std::string print(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

Image draw(const SectionCut& cut) {
  const int height = static_cast<int>(std::lround(kWidth * cut.half_across_m / cut.half_along_m));
  Image image(kWidth, height, {255, 255, 255});
  const double scale = kWidth / (2 * cut.half_along_m);
  for (const SectionPoint& p : cut.points) {
    const int x = static_cast<int>(std::lround(kWidth / 2.0 + scale * static_cast<double>(p.along)));
    const int y = static_cast<int>(std::lround(height / 2.0 - scale * static_cast<double>(p.across)));
    const auto colour = scan_colour(p.scan);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (x + dx >= 0 && x + dx < kWidth && y + dy >= 0 && y + dy < height) image.at(x + dx, y + dy) = colour;
      }
    }
  }
  return image;
}

std::string scale_bar(const SectionCut& cut) {
  const double length_m = round_length(cut.half_along_m / 2);
  const double share = 100 * length_m / (2 * cut.half_along_m);
  return "<p class=\"bar\"><i style=\"width: " + print("%.2f", share) + "%\"></i>" + length(Json(length_m)) + "</p>\n";
}

std::string swatches(const SectionCut& cut, const Json& report) {
  std::vector<std::size_t> scans;
  for (const auto& p : cut.points) {
    if (std::find(scans.begin(), scans.end(), p.scan) == scans.end()) scans.push_back(p.scan);
  }
  std::sort(scans.begin(), scans.end());
  std::string out;
  for (const std::size_t i : scans) {
    const auto c = scan_colour(i);
    out += print("<span class=\"key\"><span class=\"swatch\" style=\"background: #%02x%02x%02x\"></span>", c[0], c[1],
                 c[2]) +
           scan_label(report, report.at("scans").at(i).at("file")) + "</span>\n";
  }
  return out;
}

}  // namespace

std::string sections_section(const std::vector<SectionCut>& cuts, const Json& report) {
  std::string figures;
  for (const SectionCut& cut : cuts) {
    if (cut.points.empty()) continue;
    const Json& link = report.at("links").at(cut.link);
    const Json& r = link.at("residuals");
    figures += "<figure class=\"cut\">\n" + picture(draw(cut), "Thin section through the merged cloud") + "\n" +
               scale_bar(cut) + "<p class=\"legend\">\n" + swatches(cut, report) + "</p>\n<figcaption>" +
               (cut.is_level ? "Level" : "Upright") + " section, " + length(Json(2 * cut.half_thickness_m)) +
               " thick, where " + scan_label(report, link.at("a")) + " and " + scan_label(report, link.at("b")) +
               " meet (RMS residual " + length(r.at("rms_m")) + ").</figcaption>\n</figure>\n";
  }
  if (figures.empty()) return "";
  return section("Thin sections",
                 figures + note("All raw points within the section, each scan in its colour; the first "
                                "is at the link with the largest residuals, the second where two "
                                "scans share the most points. Where scans fit, their points lie on "
                                "one line as thick as the noise; two lines side by side are an error."));
}

}  // namespace tcm_icp::html
