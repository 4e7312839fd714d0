#pragma once

#include <optional>
#include <string>

namespace tcm_icp::app {

/// Well-known text of the coordinate system EPSG:n, as LAS and E57 want it (WKT 1), by PROJ's database. Nothing where
/// `crs` is something else, the database has no such system, or the program was built without PROJ.
std::optional<std::string> epsg_text(const std::string& crs);

}  // namespace tcm_icp::app
