#pragma once
// Measurements of a pair of scans at a pose.

#include <Eigen/Geometry>

#include "scans/prepared_scan.hpp"
#include "tcm_icp/links/link_measurements.hpp"

namespace tcm_icp {

/// Overlap and agreement of both scans' held-out points, 500 at most of each, and free space. Slides are taken in the
/// direction that overlaps more. Cost: some 9,000 queries, 3 to 6 ms; free space as much again.
LinkMeasurements measure_link(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b);

}  // namespace tcm_icp
