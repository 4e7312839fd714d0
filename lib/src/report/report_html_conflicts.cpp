#include <cmath>
#include <map>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

std::string fate_in_words(const Json& hypothesis) {
  return hypothesis.at("fate") == "open" ? "the scans are in different groups" : "the poses put the pair elsewhere";
}

}  // namespace

std::string odds(double log_odds) {
  constexpr double kOneDigitLost = 6;  // exp(6) is 400: beyond that more digits say nothing
  if (log_odds > kOneDigitLost) return "over 400 to 1";
  return figure(std::exp(std::abs(log_odds))) + (log_odds < 0 ? " to 1 against" : " to 1");
}

std::vector<const Json*> unused_links(const Json& report) {
  std::map<std::pair<std::string, std::string>, const Json*> best;
  for (const auto& h : report.at("hypotheses")) {
    const Json*& entry = best[{h.at("a").get<std::string>(), h.at("b").get<std::string>()}];
    if (entry == nullptr || h.at("log_odds") > entry->at("log_odds")) entry = &h;
  }
  std::vector<const Json*> unused;
  for (const auto& [pair, h] : best) {
    if (h->at("fate") != "confirmed" && h->at("log_odds").get<double>() > 0) unused.push_back(h);
  }
  return unused;
}

std::string conflicts_section(const Json& report) {
  Rows rows;
  for (const Json* h : unused_links(report)) {
    rows.push_back({scan_label(report, h->at("a")), scan_label(report, h->at("b")),
                    escaped(h->at("method").get<std::string>()), odds(h->at("log_odds").get<double>()),
                    percent(h->at("evidence").at("overlap")), fate_in_words(*h)});
  }
  if (rows.empty()) return "";
  return section(
      "Links that the result does not use",
      table({{"scan", "name"},
             {"scan", "name"},
             {"found by", "text"},
             {"odds by the<br/>pair alone", "number"},
             {"overlap", "number"},
             {"what became of it", "wide"}},
            rows) +
          note(
              "Each looked right by its two scans alone (odds above 1 to 1), and the registered poses say otherwise."));
}

}  // namespace tcm_icp::html
