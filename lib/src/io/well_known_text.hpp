#pragma once
// Coordinate systems as LAS 1.4 wants them.

#include <optional>
#include <string>

namespace tcm_icp {

/// `crs` where it is well-known text already, and that of the UTM zones of WGS 84 (EPSG:326nn, 327nn) and ETRS89
/// (EPSG:258nn); nothing for others, whose parameters are not known here.
std::optional<std::string> well_known_text(const std::string& crs);

}  // namespace tcm_icp
