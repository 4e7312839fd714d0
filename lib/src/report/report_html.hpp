#pragma once
// report.html: report.json for a person to read, print and sign.

#include <string>

#include "report_parts.hpp"

namespace tcm_icp {

/// One page without scripts and without links to anything outside: style and drawings are inline. It is well-formed
/// XML, too. Only what stands in `report`, as report_object() makes it, is shown; what is not known is a dash. Names
/// are escaped; what neither is UTF-8 nor can be printed becomes U+FFFD. Cost O(scans^2 + links).
std::string report_html(const Json& report);

}  // namespace tcm_icp
