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

std::string choice(const char* name, const char* value, const char* text, bool chosen) {
  return "<label><input type=\"radio\" name=\"" + std::string(name) + "\" value=\"" + value + "\"" +
         (chosen ? " checked=\"checked\"" : "") + "/>" + text + "</label>\n";
}

std::string controls() {
  return "<div class=\"view-bar\">\n<fieldset>" + choice("view-colour", "scan", "by scan", true) +
         choice("view-colour", "height", "by height", false) +
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
      draw_cloud(picture_points(scene), scene.box, PictureView::kOblique, kPictureWidth, kPictureHeight);
  return "<section>\n<div class=\"view\" id=\"view\">\n" + controls() + "<div class=\"view-stage\">\n" +
         picture(oblique, "The merged cloud, seen obliquely from above") +
         "\n<div class=\"view-legend\" hidden=\"hidden\"><i></i><span><b class=\"low\"></b><b class=\"half\"></b>"
         "<b class=\"high\"></b></span><em></em></div>\n<div class=\"view-link\" hidden=\"hidden\"></div>\n</div>\n"
         "<div class=\"view-scans\"></div>\n</div>\n"
         "<p class=\"note\">The registered scans, each in its colour. A click on a link, here or in the table of "
         "links, "
         "shows its two scans alone, how far they are apart, and where one could slide unnoticed. Cones: set-ups; "
         "balls: middles of scans whose set-up is not known.</p>\n</section>\n";
}

std::string view_scripts(const Scene& scene, const Json& report) {
  if (three_script().empty() || scene.num_points() == 0) return "";
  return script(" type=\"application/json\" id=\"view-data\"", "", view_data(scene, report), "") +
         code(three_script()) + code("(function () {\n'use strict';\n" + std::string(view_script()) + "})();");
}

}  // namespace tcm_icp::html
