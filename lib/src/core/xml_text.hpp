#pragma once
// Text within XML.

#include <string>
#include <string_view>

namespace tcm_icp {

/// For the content of elements and for attributes in double quotes: & < > " ' as references; what is not UTF-8, and
/// control characters, as U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace tcm_icp
