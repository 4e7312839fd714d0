// What would make the result firmer: in words, from the graph of links.

#include <algorithm>

#include "report/weak_spots.hpp"
#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

std::string item(const std::string& text) { return "<li>" + text + "</li>\n"; }

std::string scans_in_words(const Json& report, const std::vector<std::size_t>& scans) {
  constexpr std::size_t kMost = 6;
  std::string out;
  for (std::size_t k = 0; k < std::min(kMost, scans.size()); ++k) {
    out += (k > 0 ? ", " : "") + scan_label(report, report.at("scans").at(scans[k]).at("file"));
  }
  return out + (scans.size() > kMost ? " and " + std::to_string(scans.size() - kMost) + " more" : "");
}

std::vector<WeightedLink> held_by(const Json& report) {
  std::vector<WeightedLink> links;
  for (const auto& link : report.at("links")) {
    const double overlap = link.at("verdict") == "rejected" ? 0 : link.at("evidence").at("overlap").get<double>();
    links.push_back({scan_number(report, link.at("a")), scan_number(report, link.at("b")), overlap});
  }
  return links;
}

std::string advice(const Json& report, const WeakSpot& spot) {
  const bool one = spot.scans.size() == 1;
  std::string out =
      (one ? "Scan " : "Scans ") + scans_in_words(report, spot.scans) + (one ? " hangs" : " hang") + " on ";
  const Json& strongest = report.at("links").at(spot.links.front());
  const std::string pair = scan_label(report, strongest.at("a")) + " and " + scan_label(report, strongest.at("b"));
  if (spot.links.size() == 1) {
    out += "one link of " + percent(strongest.at("evidence").at("overlap")) + " overlap, between " + pair;
  } else {
    out += std::to_string(spot.links.size()) + " links, the strongest of " +
           percent(strongest.at("evidence").at("overlap")) + " overlap between " + pair;
  }
  return out + ": one more set-up between these two would hold " + (one ? "it." : "them.");
}

// Of the compared pairs that lead from scans that `is_inside` names to others; null where there is none.
template <typename IsInside>
const Json* likeliest_link_out(const Json& report, const IsInside& is_inside) {
  const Json* likeliest = nullptr;
  for (const auto& h : report.at("hypotheses")) {
    if (is_inside(h.at("a")) == is_inside(h.at("b"))) continue;
    if (likeliest == nullptr || h.at("log_odds") > likeliest->at("log_odds")) likeliest = &h;
  }
  return likeliest;
}

std::string look_at_these(const Json& link) {
  return ", " + percent(link.at("evidence").at("overlap")) + " overlap, " + odds(link.at("log_odds").get<double>()) +
         ": look at these two first. One more set-up between ";
}

// A group that holds together, but not with the rest, hangs on what leads out of it.
std::string advice_for_group(const Json& report, int component) {
  const auto is_inside = [&](const Json& file) {
    const Json& scan = report.at("scans").at(scan_number(report, file));
    return scan.at("status") == "unregistered" && scan.at("component") == component;
  };
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < report.at("scans").size(); ++i) {
    if (is_inside(report.at("scans").at(i).at("file"))) members.push_back(i);
  }
  const std::string start = "Scans " + scans_in_words(report, members) + " hold together (group " +
                            std::to_string(component) + "), but are not registered with the others. ";
  const Json* likeliest = likeliest_link_out(report, is_inside);
  if (likeliest == nullptr || likeliest->at("log_odds").get<double>() <= 0) {
    return start +
           "No pair of theirs with one of them looks right: scan again from between, with 30\u202F% overlap or more, "
           "or leave them out where they are of another place.";
  }
  return start + "The likeliest link is " + scan_label(report, likeliest->at("a")) + " with " +
         scan_label(report, likeliest->at("b")) + look_at_these(*likeliest) + "the group and the others is needed.";
}

std::string advice_for_unregistered(const Json& report, const Json& scan) {
  const auto is_inside = [&](const Json& file) { return file == scan.at("file"); };
  const std::string label = scan_label(report, scan.at("file"));
  const Json* likeliest = likeliest_link_out(report, is_inside);
  if (likeliest == nullptr) {
    return label +
           " shares nothing that was found with any other scan: scan again from between it and its neighbours, "
           "30\u202F% overlap or more.";
  }
  const Json& other = is_inside(likeliest->at("a")) ? likeliest->at("b") : likeliest->at("a");
  return label + " is not registered (" + sentence(scan.at("reason")) + "). Its likeliest link is with " +
         scan_label(report, other) + look_at_these(*likeliest) + "them would show whether it is right.";
}

}  // namespace

std::string help_section(const Json& report) {
  if (!verifies(report)) return "";
  constexpr std::size_t kMostSpots = 5;
  constexpr double kFirm = 0.6;  // two links of 30 %, the least overlap that surveyors plan with
  std::string items;
  std::vector<std::size_t> registered;
  std::vector<int> groups;
  for (std::size_t i = 0; i < report.at("scans").size(); ++i) {
    const Json& scan = report.at("scans").at(i);
    if (scan.at("status") != "unregistered") {
      registered.push_back(i);
    } else if (scan.at("middle_m").is_null()) {  // in no group
      items += item(advice_for_unregistered(report, scan));
    } else if (const int component = scan.at("component");
               std::find(groups.begin(), groups.end(), component) == groups.end()) {
      groups.push_back(component);
      items += item(advice_for_group(report, component));
    }
  }
  std::size_t num_weak = 0;
  const std::vector<WeakSpot> spots = weak_spots(registered, held_by(report));
  for (const WeakSpot& spot : spots) {
    if (num_weak == kMostSpots || spot.links.empty() || spot.weight >= kFirm) break;
    items += item(advice(report, spot));
    ++num_weak;
  }
  if (num_weak == 0 && !spots.empty()) {
    const WeakSpot& least = spots.front();
    items += item("The net of registered scans has no weak place. What is held least, " +
                  scans_in_words(report, least.scans) + ", has " + std::to_string(least.links.size()) +
                  " links to the rest, whose overlaps add up to " + percent(Json(least.weight)) + ".");
  }
  if (report.contains("acceptance") && report.at("acceptance").at("passed") == false) {
    items += item(
        "Scans that fail the limits are named on top. Colour the view by distance to other scans: where walls are "
        "red, scan again; where only leaves or edges are, the limit is narrower than the scene allows.");
  }
  if (items.empty()) return "";
  return section("What would help",
                 "<ul>\n" + items + "</ul>\n" +
                     note("The weakest places of the net: scans, or groups of scans, that the fewest "
                          "and slightest links hold to the others."));
}

}  // namespace tcm_icp::html
