#include <algorithm>

#include "report/base64.hpp"
#include "report/cloud_picture.hpp"
#include "report/page_texts.hpp"
#include "report/view_data.hpp"
#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

constexpr int kPictureWidth = 1100, kPictureHeight = 620;

// What a script element holds is neither escaped nor read as markup, as HTML; as XML it is character data.
std::string script(std::string_view attributes, std::string_view before, std::string_view text,
                   std::string_view after) {
  return "<script" + std::string(attributes) + ">" + std::string(before) + std::string(text) + std::string(after) +
         "</script>\n";
}

std::string code(std::string_view text) { return script("", "//<![CDATA[\n", text, "\n//]]>"); }

std::string choice(const char* name, const char* value, const std::string& text, bool chosen) {
  return "<label><input type=\"radio\" name=\"" + std::string(name) + "\" value=\"" + value + "\"" +
         (chosen ? " checked=\"checked\"" : "") + "/>" + text + "</label>\n";
}

// Groups have nothing to do with each other's frames: one at a time is shown.
std::string group_choice(const Scene& scene) {
  if (scene.groups.size() < 2) return "";
  std::string out = "<fieldset class=\"view-groups\">" + choice("view-group", "0", "registered scans", true);
  for (std::size_t g = 1; g < scene.groups.size(); ++g) {
    const auto n =
        std::count_if(scene.scans.begin(), scene.scans.end(), [g](const SceneScan& scan) { return scan.group == g; });
    out += choice("view-group", std::to_string(g).c_str(),
                  "group " + std::to_string(scene.groups[g].component) + ": " + std::to_string(n) +
                      " scans not registered with them",
                  false);
  }
  return out + "</fieldset>\n";
}

std::string controls(const Scene& scene) {
  return "<div class=\"view-bar\">\n" + group_choice(scene) + "<fieldset>" +
         choice("view-colour", "scan", "by scan", true) + choice("view-colour", "height", "by height", false) +
         choice("view-colour", "distance", "by distance to other scans", false) + "</fieldset>\n<fieldset>" +
         choice("view-state", "registered", "registered", true) +
         choice("view-state", "input", "as the files have them", false) +
         "</fieldset>\n<label><input type=\"checkbox\" name=\"view-links\" checked=\"checked\"/>links</label>\n"
         "<label><input type=\"checkbox\" name=\"view-setups\" checked=\"checked\"/>set-ups</label>\n"
         "<span><button type=\"button\" data-look=\"top\">Top</button> "
         "<button type=\"button\" data-look=\"side\">Side</button> "
         "<button type=\"button\" data-look=\"oblique\">Oblique</button></span>\n"
         "<label>points <input type=\"range\" name=\"view-size\" min=\"-1\" max=\"2\" step=\"0.25\" "
         "value=\"0\"/></label>\n"
         "</div>\n";
}

}  // namespace

std::string picture(const Image& image, std::string_view description) {
  const std::string bytes = png(image);
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return "<img alt=\"" + escaped(description) + "\" width=\"" + std::to_string(image.width) + "\" height=\"" +
         std::to_string(image.height) + "\" src=\"data:image/png;base64," + base64({data, bytes.size()}) + "\"/>";
}

std::string view_section(const Scene& scene) {
  if (scene.num_points() == 0) return "";
  const Image oblique =
      draw_cloud(picture_points(scene), scene.registered().box, PictureView::kOblique, kPictureWidth, kPictureHeight);
  return "<section>\n<div class=\"view\" id=\"view\">\n" + controls(scene) + "<div class=\"view-stage\">\n" +
         picture(oblique, "The merged cloud, seen obliquely from above") +
         "\n<div class=\"view-legend\" hidden=\"hidden\"><i></i><span><b class=\"low\"></b><b class=\"half\"></b>"
         "<b class=\"high\"></b></span><em></em></div>\n<div class=\"view-own\" hidden=\"hidden\"></div>"
         "<div class=\"view-link\" hidden=\"hidden\"></div>\n</div>\n"
         "<div class=\"view-scans\"></div>\n</div>\n"
         "<p class=\"note\">The registered scans, each in its colour. A click on a link, here or in the table of "
         "links, "
         "shows its two scans alone, how far they are apart, and where one could slide unnoticed. Cones: set-ups; "
         "balls: middles of scans whose set-up is not known." +
         (scene.groups.size() > 1
              ? " Groups that hold together, but are not registered with the rest, are shown one at a time, each in a "
                "frame of its own; the picture and registered.ply are without them."
              : "") +
         "</p>\n</section>\n";
}

std::string view_scripts(const Scene& scene, const Json& report) {
  if (three_script().empty() || scene.num_points() == 0) return "";
  return script(" type=\"application/json\" id=\"view-data\"", "", view_data(scene, report), "") +
         code(three_script()) + code("(function () {\n'use strict';\n" + std::string(view_script()) + "})();");
}

}  // namespace tcm_icp::html
