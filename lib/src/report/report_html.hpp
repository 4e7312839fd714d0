#pragma once
// report.html: report.json for a person to read, print and sign.

#include <string>
#include <vector>

#include "report/scene.hpp"
#include "report/section_cut.hpp"
#include "report_parts.hpp"

namespace tcm_icp {

/// One page that loads nothing, which its content security policy has browsers enforce: style, pictures and scripts
/// are inline, and without scripts only the 3D view is missing. It is well-formed XML, too. Only what stands in
/// `report`, as report_object() makes it, is shown; what is not known is a dash. Names are escaped; what neither is
/// UTF-8 nor can be printed becomes U+FFFD. Cost O(scans^2 + links + points).
/// @param scene  points to show; without any the page has tables and drawings alone
std::string report_html(const Json& report, const Scene& scene = {}, const std::vector<SectionCut>& sections = {});

}  // namespace tcm_icp
