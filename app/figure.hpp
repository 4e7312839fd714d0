#pragma once

#include <string>

namespace tcm_icp::app {

/// A cell of a table: the value by a format of printf, "-" where it is not finite.
std::string figure(const char* format, double value);

}  // namespace tcm_icp::app
