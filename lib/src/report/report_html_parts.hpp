#pragma once
// The sections of report.html, in the order of the page, and what they ask of a report.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/png.hpp"
#include "report/scene.hpp"
#include "report/section_cut.hpp"
#include "report_parts.hpp"

namespace tcm_icp::html {

std::string verdict_section(const Json& report);  ///< how many scans are registered, which are not, and why
std::string facts_section(const Json& report);    ///< the figures that matter most
std::string view_section(const Scene& scene);     ///< the merged cloud, as a picture that a script makes a 3D view of
std::string plan_section(const Json& report,
                         const Scene& scene);  ///< top view: scans where they were registered, and their links
std::string scans_section(const Json& report);
std::string survey_section(const Json& report);  ///< empty where no survey frame was asked for
std::string poses_section(const Json& report);   ///< where each scan lies, in numbers
std::string help_section(const Json& report);    ///< what would make the result firmer
std::string loops_section(const Json& report);
std::string sections_section(const std::vector<SectionCut>& cuts, const Json& report);
std::string links_section(const Json& report);
std::string conflicts_section(const Json& report);  ///< links that contradict the poses; empty where there are none
std::string pairs_section(const Json& report);      ///< of a conventional method; else empty
std::string merges_section(const Json& report);
std::string adjustment_section(const Json& report);
std::string measured_section(const Json& report);
std::string stages_section(const Json& report);
std::string options_section(const Json& report);
std::string signature_section();
/// At the end of the page; empty where the program was built without three.js.
std::string view_scripts(const Scene& scene, const Json& report);
/// An image within the page.
std::string picture(const Image& image, std::string_view description);

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

/// By RMS residual, those without one last.
std::vector<std::size_t> links_worst_first(const Json& report);
/// "pass", or "fail" with what fails, of a scan's or link's acceptance; nothing where no limits were given.
std::string passed(const Json& of);

/// "12 to 1" for log-odds
std::string odds(double log_odds);

}  // namespace tcm_icp::html
