#include <algorithm>
#include <cmath>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

bool registered(const Json& scan) { return scan.at("status") != "unregistered"; }

// Of one scan there is nothing to say but that it stands by itself.
bool is_alone(const Json& report) {
  const auto& scans = report.at("scans");
  return std::count_if(scans.begin(), scans.end(), registered) == 1;
}

std::string unregistered_list(const Json& report) {
  std::string items;
  for (const auto& scan : report.at("scans")) {
    if (registered(scan)) continue;
    items += "<li>" + scan_label(report, scan.at("file")) + ": " + sentence(scan.at("reason")) + "</li>\n";
  }
  return items.empty() ? "" : "<p>Not registered:</p>\n<ul>\n" + items + "</ul>\n";
}

std::string remarks(const Json& report) {
  std::string out;
  const auto remark = [&](const std::string& text) { out += "<p>" + text + "</p>\n"; };
  if (!verifies(report)) {
    remark(
        "Nothing was verified: this method takes every pose it finds. Whether a scan is in its place has to be "
        "shown by other means.");
  }
  for (const auto& pair : report.at("adjustment").at("outlying_links")) {
    remark(scan_label(report, pair.at(0)) + " and " + scan_label(report, pair.at(1)) +
           " fit each other far worse than other pairs do.");
  }
  const Json survey = report.value("survey", Json());
  if (!survey.is_null()) {
    for (const auto& point : survey.at("points")) {
      if (point.at("status") != "blunder") continue;
      const std::string what = point.at("kind") == "scanner" ? "The position of " + file_name(point.at("scan"))
                                                             : "Control point " + file_name(point.at("name")) + " in " +
                                                                   file_name(point.at("scan"));
      remark(what + " contradicts the others and was left out.");
    }
    for (const auto& text : survey.at("remarks")) remark(sentence(text));
  }
  for (const auto& warning : report.value("warnings", Json::array())) remark(sentence(warning));
  std::string free, unchecked;
  for (const auto& scan : report.at("scans")) {
    if (scan.at("status") == "unregistered" || !verifies(report)) continue;
    const std::string label = scan_label(report, scan.at("file"));
    const bool is_free =
        scan.at("status") == "registered" && scan.contains("uncertainty") && scan.at("uncertainty").is_null();
    if (is_free) free += (free.empty() ? "" : ", ") + label;
    if (!is_alone(report) && accepted_links(report, scan.at("file")) < 2)
      unchecked += (unchecked.empty() ? "" : ", ") + label;
  }
  if (!free.empty()) remark("Not fixed in all directions by the points that match: " + free + ".");
  if (!unchecked.empty()) {
    remark("With fewer than two accepted links, so that no loop of such links checks their poses: " + unchecked + ".");
  }
  return out;
}

std::string limits_in_words(const Json& limits) {
  std::string out;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (!limits.at("residual_m").is_null()) add("RMS residual at most " + length(limits.at("residual_m")));
  if (!limits.at("overlap").is_null()) add("overlap at least " + percent(limits.at("overlap")));
  if (!limits.at("sigma_m").is_null()) add("1\u03C3 of a position at most " + length(limits.at("sigma_m")));
  return out;
}

std::string acceptance(const Json& report) {
  if (!report.contains("acceptance")) {
    return "<p class=\"note\">No limits were given, so it is not said whether the result is exact enough: "
           "--accept-residual, "
           "--accept-overlap and --accept-sigma of tcm-icp register do that.</p>\n";
  }
  const Json& limits = report.at("acceptance");
  const std::string asked = limits_in_words(limits);
  if (limits.at("passed") == true) {
    std::string out = "<p><b>Within the limits</b>: every scan keeps " + asked + ".</p>\n";
    if (limits.at("failed_links") != 0) {
      out += "<p>" + count(limits.at("failed_links")) + " of " + std::to_string(report.at("links").size()) +
             " links by themselves do not; their scans are held by others.</p>\n";
    }
    return out;
  }
  std::string items;
  std::size_t num_registered = 0, num_failed = 0;
  for (const auto& scan : report.at("scans")) {
    if (!registered(scan)) continue;
    ++num_registered;
    if (scan.at("acceptance").at("passed") == true) continue;
    ++num_failed;
    std::string why;
    for (const auto& failure : scan.at("acceptance").at("failures"))
      why += (why.empty() ? "" : "; ") + sentence(failure);
    items += "<li>" + scan_label(report, scan.at("file")) + ": " + why + "</li>\n";
  }
  if (num_failed == 0) {
    return "<p><b>Outside the limits</b>: scans are not registered. Those that are keep " + asked + ".</p>\n";
  }
  return "<p><b>Outside the limits</b>: " + std::to_string(num_failed) + " of " + std::to_string(num_registered) +
         (num_registered < report.at("scans").size() ? " registered scans" : " scans") +
         (num_failed == 1 ? " does not keep " : " do not keep ") + asked + ".</p>\n<ul>\n" + items + "</ul>\n";
}

bool has_blunder(const Json& report) {
  const Json survey = report.value("survey", Json());
  if (survey.is_null()) return false;
  const auto& points = survey.at("points");
  return std::any_of(points.begin(), points.end(), [](const Json& p) { return p.at("status") == "blunder"; });
}

// The largest norm over the registered scans, NaN where none is known.
double largest_sigma(const Json& report, const char* name) {
  double largest = std::nan("");
  for (const auto& scan : report.at("scans")) {
    const bool counts =
        scan.at("status") == "registered" || (scan.at("status") == "reference" && !in_frame_of_reference(report));
    if (!counts || !scan.contains("uncertainty") || scan.at("uncertainty").is_null()) continue;
    double square = 0;
    for (const auto& s : scan.at("uncertainty").at(name)) square += s.is_number() ? std::pow(s.get<double>(), 2) : 0;
    largest = std::fmax(largest, std::sqrt(square));
  }
  return largest;
}

double worst_residual_mm(const Json& report) {
  double worst = std::nan("");
  for (const auto& scan : report.at("scans")) {
    if (!registered(scan) || scan.at("evidence").is_null()) continue;
    const Json& residual = scan.at("evidence").at("median_residual_m");
    if (residual.is_number()) worst = std::fmax(worst, 1000 * residual.get<double>());
  }
  return worst;
}

std::string key_figures(const Json& report) {
  long long points = 0;
  double seconds = 0, memory_mb = 0;
  for (const auto& scan : report.at("scans")) points += scan.at("points").get<long long>();
  for (const auto& stage : report.at("stages")) {
    seconds += stage.at("seconds").get<double>();
    memory_mb = std::max(memory_mb, stage.at("peak_memory_mb").get<double>());
  }
  const auto& links = report.at("links");
  const auto accepted =
      std::count_if(links.begin(), links.end(), [](const auto& l) { return l.at("verdict") == "accepted"; });
  std::vector<std::pair<std::string, std::string>> pairs{
      {"reference scan", scan_label(report, report.at("graph").at("reference"))}, {"points read", count(Json(points))}};
  if (!links.empty()) {
    pairs.push_back({"links accepted", std::to_string(accepted) + " of " + std::to_string(links.size())});
  }
  std::vector<std::size_t> order = links_worst_first(report);
  std::erase_if(order, [&](std::size_t k) {
    return !registered(report.at("scans").at(scan_number(report, links.at(k).at("a"))));
  });
  if (!order.empty() && report.contains("residuals") && !report.at("residuals").is_null()) {
    const Json& worst = links.at(order.front());
    if (!worst.at("residuals").is_null()) {
      pairs.push_back({"worst link", scan_label(report, worst.at("a")) + " \u2013 " +
                                         scan_label(report, worst.at("b")) + ", RMS " +
                                         length(worst.at("residuals").at("rms_m"))});
    }
    pairs.push_back({"RMS residual of all links", length(report.at("residuals").at("rms_m"))});
    if (!report.at("residuals").at("share_within_limit").is_null()) {
      pairs.push_back({"points within the limit", percent(report.at("residuals").at("share_within_limit"))});
    }
  }
  const double residual = worst_residual_mm(report);
  if (std::isfinite(residual)) pairs.push_back({"largest median residual of a scan", figure(residual) + " mm"});
  const double position = 1000 * largest_sigma(report, "sigma_position_m"),
               turn = largest_sigma(report, "sigma_rotation_deg");
  if (std::isfinite(position)) pairs.push_back({"largest 1\u03C3 of a position", figure(position) + " mm"});
  if (std::isfinite(turn)) pairs.push_back({"largest 1\u03C3 of a rotation", figure(turn) + "\u00B0"});
  pairs.push_back({"time", figure(seconds) + " s"});
  pairs.push_back({"most memory", figure(memory_mb) + " MiB"});
  return facts(pairs);
}

}  // namespace

std::string verdict_section(const Json& report) {
  const auto& scans = report.at("scans");
  const auto placed = std::count_if(scans.begin(), scans.end(), registered);
  const bool all = placed == static_cast<std::ptrdiff_t>(scans.size());
  const std::string of =
      all ? "All " + std::to_string(placed) : std::to_string(placed) + " of " + std::to_string(scans.size());
  const bool doubts = !verifies(report) || !report.at("adjustment").at("outlying_links").empty() || has_blunder(report);
  const bool passes = !report.contains("acceptance") || report.at("acceptance").at("passed") == true;
  const std::string kind = !all || !passes ? "bad" : doubts ? "fair" : "good";
  const std::string line = !verifies(report)  ? of + " scans have a pose, none of them verified."
                           : is_alone(report) ? "No scan is registered with another: " + std::to_string(scans.size()) +
                                                    " scans, and nothing that holds two of them together in the "
                                                    "frame of the reference."
                                              : of + " scans are registered.";
  return "<section>\n<div class=\"verdict " + kind + "\">\n<p class=\"line\">" + line + "</p>\n" + acceptance(report) +
         unregistered_list(report) + remarks(report) + "</div>\n</section>\n";
}

std::string facts_section(const Json& report) { return "<section>\n" + key_figures(report) + "</section>\n"; }

}  // namespace tcm_icp::html
