#pragma once
// The sections of report.html, in the order of the page, and what they ask of a report.

#include <cstddef>
#include <string>
#include <vector>

#include "report_parts.hpp"

namespace tcm_icp::html {

const char* style_sheet();

std::string verdict_section(const Json& report);  ///< how many scans are registered, which are not, and why
std::string plan_section(const Json& report);     ///< top view: scans where they were registered, and their links
std::string scans_section(const Json& report);
std::string survey_section(const Json& report);  ///< empty where no survey frame was asked for
std::string links_section(const Json& report);
std::string conflicts_section(const Json& report);  ///< links that contradict the poses; empty where there are none
std::string pairs_section(const Json& report);      ///< of a conventional method; else empty
std::string merges_section(const Json& report);
std::string adjustment_section(const Json& report);
std::string measured_section(const Json& report);
std::string stages_section(const Json& report);
std::string options_section(const Json& report);
std::string signature_section();

/// Number of a scan on the command line, from 0, as in registered.ply. @pre the report has the file
std::size_t scan_number(const Json& report, const Json& file);
/// "3 name.ply"
std::string scan_label(const Json& report, const Json& file);

/// Links of a scan that their own points confirm.
std::ptrdiff_t accepted_links(const Json& report, const Json& file);

/// Whether poses are in the frame of the reference scan, where that scan is exact by definition.
bool in_frame_of_reference(const Json& report);

/// Whether the run verifies what it does: the published method and conventional ones do not.
bool verifies(const Json& report);

/// Best hypothesis of each pair that is more likely right than wrong, and that the final poses do not bear out.
std::vector<const Json*> unused_links(const Json& report);

/// "12 to 1" for log-odds
std::string odds(double log_odds);

}  // namespace tcm_icp::html
