#pragma once
// Texts that are built into the program from files: page/ beside this file, and three.js where it is installed.

#include <string_view>

namespace tcm_icp::html {

std::string_view style_sheet();
std::string_view view_script();
/// three.js and its controls; empty where the program was built without.
std::string_view three_script();

}  // namespace tcm_icp::html
