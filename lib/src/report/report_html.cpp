#include "report_html.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "report/page_texts.hpp"
#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp {
namespace {

std::string text_at(const Json& report, const char* key) {
  const Json& value = report.at(key);
  return value.is_string() ? html::escaped(value.get_ref<const std::string&>()) : "";
}

// Within a string of a style sheet; whoever names a project does not write styles.
std::string css_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\' || c == '<' || c == '>' || c == '&' || static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof code, "\\%02x ", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += code;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

// Header, page number and a line to sign on each printed page.
std::string page_margins(const Json& report) {
  const Json project = report.value("project", Json::object()).value("project", Json());
  // By way of JSON, which has no bytes that are not UTF-8.
  const std::string name =
      project.is_string() ? Json::parse(json_text(project)).get<std::string>() : "Registration report";
  const std::string started =
      report.at("started").is_string() ? report.at("started").get<std::string>().substr(0, 10) : "";
  return "@page {\n  @top-left { content: " + css_string(name) + "; }\n  @top-right { content: " +
         css_string(started + (started.empty() ? "" : "  \u00B7  ") + report.at("program").get<std::string>() + " " +
                    report.at("version").get<std::string>()) +
         "; }\n  @bottom-left { content: \"Page \" counter(page) \" of \" counter(pages); }\n"
         "  @bottom-right { content: \"Signature ______________________\"; }\n}\n";
}

std::string head(const Json& report) {
  return "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
         "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "script-src 'unsafe-inline'; img-src data:\"/>\n"
         "<title>Registration report</title>\n<style>\n" +
         std::string(html::style_sheet()) + page_margins(report) + "</style>\n</head>\n<body>\n";
}

std::string title(const Json& report) {
  std::string started = text_at(report, "started");
  if (started.size() > 10) started = started.substr(0, 10) + " " + started.substr(11);
  const Json told = report.value("project", Json::object());
  const Json name = told.value("project", Json());
  std::string people;
  constexpr std::array<std::pair<const char*, const char*>, 3> kTold{
      {{"client", "Client: "}, {"instrument", "Instrument: "}, {"operator", "Operator: "}}};
  for (const auto& [key, label] : kTold) {
    const Json value = told.value(key, Json());
    if (value.is_string())
      people += (people.empty() ? "" : " \u00B7 ") + std::string(label) + html::escaped(value.get<std::string>());
  }
  const std::string what = "Registration of " + std::to_string(report.at("scans").size()) + " scans";
  return "<header>\n<h1>" + (name.is_string() ? html::escaped(name.get<std::string>()) : what) + "</h1>\n<p>" +
         (name.is_string() ? what + " \u00B7 " : "") + started + (started.empty() ? "" : " \u00B7 ") +
         text_at(report, "program") + " " + text_at(report, "version") + "</p>\n" +
         (people.empty() ? "" : "<p>" + people + "</p>\n") + "</header>\n";
}

}  // namespace

std::string report_html(const Json& report, const Scene& scene, const std::vector<SectionCut>& sections) {
  using namespace html;
  return head(report) + title(report) + "<main>\n" + verdict_section(report) + view_section(scene) +
         facts_section(report) + help_section(report) + scans_section(report) + links_section(report) +
         plan_section(report, scene) + sections_section(sections, report) + poses_section(report) +
         survey_section(report) + loops_section(report) + conflicts_section(report) + pairs_section(report) +
         merges_section(report) + adjustment_section(report) + measured_section(report) + stages_section(report) +
         options_section(report) + signature_section() + "</main>\n" + view_scripts(scene, report) +
         "</body>\n</html>\n";
}

}  // namespace tcm_icp
