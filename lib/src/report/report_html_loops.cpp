#include "report_html_parts.hpp"
#include "report_html_text.hpp"

namespace tcm_icp::html {

std::string loops_section(const Json& report) {
  const Json loops = report.value("misclosures", Json());
  if (loops.is_null() || loops.at("loops") == 0) return "";
  Rows rows;
  for (const auto& loop : loops.at("worst")) {
    std::string scans;
    for (const auto& file : loop.at("scans")) scans += (scans.empty() ? "" : " \u2013 ") + scan_label(report, file);
    rows.push_back({scans, figure(loop.at("distance_m"), 1000), figure(loop.at("rotation_deg"))});
  }
  const std::string number = count(loops.at("loops")) + (loops.at("loops") == 1 ? " loop" : " loops");
  return section(
      "Loop misclosures",
      "<p>" + number + " of three scans; root mean square misclosure " + length(loops.at("rms_m")) + ".</p>\n" +
          table({{"around", "wide"}, {"misclosure<br/>[mm]", "number"}, {"[\u00B0]", "number"}}, rows) +
          note("Each pair of a loop was fitted by itself, at voxels of " + length(report.at("coarse_voxel_m")) +
               ", before all were adjusted together; going round, one should come back to the start. What "
               "is left, at the middle of the first scan\u2019s points, checks pairs by one another, the "
               "worst first."));
}

}  // namespace tcm_icp::html
