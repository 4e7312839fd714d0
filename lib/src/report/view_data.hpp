#pragma once
// What the script of the 3D view reads.

#include <string>

#include "report/report_parts.hpp"
#include "report/scene.hpp"

namespace tcm_icp {

/// JSON that may stand inside a script element: points as base64 of 16-bit numbers within each scan's box.
/// @param report  as report_object() makes it
std::string view_data(const Scene& scene, const Json& report);

}  // namespace tcm_icp
