#include <algorithm>

#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {
namespace {

// "4 of 8, kept"
std::string trace(const Json& merge, const char* name) {
  if (!merge.contains(name)) return figure(Json());
  const Json& t = merge.at(name);
  return std::to_string(t.at("accepted_steps").get<int>()) + " of " + std::to_string(t.at("steps").get<int>()) +
         (t.at("kept").get<bool>() ? ", kept" : ", not kept");
}

bool is_fitted(const Json& merge) { return merge.at("simplex").at("termination") != "not run"; }

Rows order_rows(const Json& report) {
  Rows rows;
  for (const auto& m : report.at("merges")) {
    rows.push_back({std::to_string(rows.size() + 1), scan_label(report, m.at("scan")), figure(m.at("tcm").at("tau"))});
  }
  return rows;
}

Rows merge_rows(const Json& report) {
  Rows rows = order_rows(report);
  Json sum = Json::object();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Json& m = report.at("merges").at(k);
    const Json& lp = m.at("simplex").at("lp");
    const bool accepted = m.at("accepted").get<bool>();
    rows[k].insert(rows[k].end(), {badge(accepted ? "good" : "fair", accepted ? "fitted" : "not fitted"),
                                   count(lp.at("programs")), count(lp.at("pivots")), figure(lp.at("seconds"), 1000),
                                   figure(m.at("simplex").at("median_residual_m"), 1000), trace(m, "descent"),
                                   trace(m, "annealing"), accepted ? "" : sentence(m.at("reason"))});
    sum["programs"] = sum.value("programs", 0LL) + lp.at("programs").get<long long>();
    sum["pivots"] = sum.value("pivots", 0LL) + lp.at("pivots").get<long long>();
    sum["seconds"] = sum.value("seconds", 0.0) + lp.at("seconds").get<double>();
    for (const char* name : {"descent_steps", "annealing_steps"}) {
      sum[name] = sum.value(name, 0LL) + m.at("iterations").at(name).get<long long>();
    }
  }
  rows.push_back({"", "<b>sum</b>", "", "", count(sum.at("programs")), count(sum.at("pivots")),
                  figure(sum.at("seconds"), 1000), "", count(sum.at("descent_steps")), count(sum.at("annealing_steps")),
                  ""});
  return rows;
}

}  // namespace

std::string merges_section(const Json& report) {
  const Json& merges = report.at("merges");
  if (merges.empty()) return "";
  const bool paper = report.at("options").at("profile") == "paper";
  const std::string next =
      "The scan with the least Transformation Compatibility Measure \u03C4 against the merged cloud is placed next, of "
      "those that links or initial poses lead to.";
  std::vector<Column> columns{{"step", "number"},
                              {"scan", "name"},
                              {paper ? "TCM \u03C4<br/>[m\u2074]" : "TCM \u03C4<br/>[m\u00B2]", "number"}};
  if (std::none_of(merges.begin(), merges.end(), is_fitted)) {
    return section("Merge order", table(columns, order_rows(report)) +
                                      note(next + " Each is placed where all links together put it; the joint "
                                                  "adjustment starts from there."));
  }
  columns.insert(columns.end(), {Column{"result", "text"},
                                 {"linear<br/>programs", "number"},
                                 {"simplex<br/>pivots", "number"},
                                 {"solver<br/>[ms]", "number"},
                                 {"residual<br/>[mm]", "number"},
                                 {"descent", "trace"},
                                 {"annealing", "trace"},
                                 {"reason", "wide"}});
  return section("Merge order",
                 table(columns, merge_rows(report)) +
                     note(next + " Descent and annealing: steps that were accepted of those tried, and whether points "
                                 "that they did not see confirmed what they found."));
}

std::string adjustment_section(const Json& report) {
  const Json& a = report.at("adjustment");
  if (a.at("steps") == 0 && a.at("lp").at("programs") == 0) return "";
  const Json& lp = a.at("lp");
  return section(
      "Joint adjustment of all poses",
      facts({{"linear programs", count(lp.at("programs")) + ", " + escaped(a.at("lp_status").get<std::string>())},
             {"simplex pivots", count(lp.at("pivots"))},
             {"matches in the last program", count(a.at("lp_matches"))},
             {"solver time", figure(lp.at("seconds")) + " s"},
             {"largest relative duality gap", figure(lp.at("largest_relative_duality_gap"))},
             {"rms move by the last program", figure(a.at("lp_rms_move_m"), 1000) + " mm"},
             {"least-squares steps", count(a.at("steps"))},
             {"rms move in the last step", figure(a.at("rms_move_m"), 1000) + " mm"},
             {"scans are bent by, at least", figure(a.at("bending_m"), 1000) + " mm"},
             {"scanners moved in a turn by, at least", figure(a.at("motion_m"), 1000) + " mm"},
             {"noise of distances to planes", figure(a.at("noise_m"), 1000) + " mm"},
             {"errors are independent beyond", figure(a.at("block_m")) + " m"},
             {"1\u03C3 grew by correlation", "\u00D7 " + figure(a.at("correlation_factor"))},
             {"1\u03C3 grew by contradicting links", "\u00D7 " + figure(a.at("disagreement_factor"))}}));
}

std::string pairs_section(const Json& report) {
  if (!report.contains("conventional")) return "";
  Rows rows;
  for (const auto& p : report.at("conventional").at("pairs")) {
    const bool used = p.at("in_tree").get<bool>(), converged = p.at("converged").get<bool>();
    rows.push_back({scan_label(report, p.at("source")), scan_label(report, p.at("target")), used ? "<b>used</b>" : "",
                    badge(converged ? "plain" : "fair", converged ? "converged" : "not converged"),
                    percent(p.at("share")), figure(p.at("mean_distance_m"), 1000), count(p.at("iterations").at("icp")),
                    count(p.at("iterations").at("ransac"))});
  }
  return section("Pairs fitted by " + escaped(report.at("method").get<std::string>()),
                 table({{"source", "name"},
                        {"target", "name"},
                        {"by the poses", "text"},
                        {"fit", "text"},
                        {"share with<br/>a partner", "number"},
                        {"mean distance<br/>[mm]", "number"},
                        {"ICP<br/>iterations", "number"},
                        {"RANSAC<br/>iterations", "number"}},
                       rows));
}

}  // namespace tcm_icp::html
