#include "report_html.hpp"

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp {
namespace {

std::string text_at(const Json& report, const char* key) {
  const Json& value = report.at(key);
  return value.is_string() ? html::escaped(value.get_ref<const std::string&>()) : "";
}

std::string head() {
  return "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
         "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
         "<title>Registration report</title>\n<style>\n" +
         std::string(html::style_sheet()) + "</style>\n</head>\n<body>\n";
}

std::string title(const Json& report) {
  std::string started = text_at(report, "started");
  if (started.size() > 10) started = started.substr(0, 10) + " " + started.substr(11);
  return "<header>\n<h1>Registration of " + std::to_string(report.at("scans").size()) + " scans</h1>\n<p>" + started +
         (started.empty() ? "" : " \u00B7 ") + text_at(report, "program") + " " + text_at(report, "version") +
         "</p>\n</header>\n";
}

}  // namespace

std::string report_html(const Json& report) {
  using namespace html;
  return head() + title(report) + "<main>\n" + verdict_section(report) + plan_section(report) + scans_section(report) +
         survey_section(report) + conflicts_section(report) + links_section(report) + pairs_section(report) +
         merges_section(report) + adjustment_section(report) + measured_section(report) + stages_section(report) +
         options_section(report) + signature_section() + "</main>\n</body>\n</html>\n";
}

}  // namespace tcm_icp
