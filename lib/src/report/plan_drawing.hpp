#pragma once
// The top view of scans that share a frame, as inline SVG.

#include <cstddef>
#include <string>
#include <vector>

#include "plan_layout.hpp"
#include "report_parts.hpp"

namespace tcm_icp::html {

struct PlanGroup {
  int component = 0;
  std::vector<std::size_t> scans;  ///< numbers of those with a place
  PlanLayout layout;               ///< of these
  std::string background;          ///< SVG behind them, or nothing
};

/// Discs with the scans' numbers and colours, what they cover, their links by verdict, and a scale.
std::string plan_drawing(const PlanGroup& group, const Json& report);

}  // namespace tcm_icp::html
