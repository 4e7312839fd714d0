#pragma once
// Control points and positions of scanners in files (docs/formats.md).

#include <filesystem>
#include <vector>

#include "tcm_icp/survey/survey.hpp"

namespace tcm_icp {

/// Control points for the scans `scans`: name, scan (or *), x, y, z, X, Y, Z, sigma, and where wanted sigma_scan and
/// use. Measured coordinates are multiplied by the unit of their scan's path; without sigma_scan half the variance of
/// sigma counts for the measured ones.
/// @throws InputError  naming file, line and remedy: a column missing, not a number, an unknown scan, no point, a name
///                     with two given places
std::vector<ControlPoint> read_control_file(const std::filesystem::path& path,
                                            const std::vector<std::filesystem::path>& scans);

/// Positions of scanners: scan, X, Y, Z, sigma, and where wanted the scanner's place x, y, z in the scan (otherwise its
/// origin).
/// @throws InputError  as above, and a scan twice
std::vector<ControlPoint> read_scanner_positions(const std::filesystem::path& path,
                                                 const std::vector<std::filesystem::path>& scans);

}  // namespace tcm_icp
