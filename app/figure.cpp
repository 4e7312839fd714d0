#include "figure.hpp"

#include <cmath>
#include <cstdio>

namespace tcm_icp::app {

std::string figure(const char* format, double value) {
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace tcm_icp::app
