#pragma once
// Which overlapping pairs take part in the joint adjustment.

#include <Eigen/Geometry>
#include <vector>

#include "joint_matches.hpp"
#include "pose_graph.hpp"
#include "prepared_scan.hpp"

namespace tcm_icp {

/// Without pairs that were compared and of which no hypothesis leads to their pose, as long as other pairs connect
/// both scans. Such a pair shares little, and what its surfaces lie next to may be a wall's other face: a scan of the
/// simulated interiors was drawn off by 0.1 m. Pairs that were not compared stay.
/// @param T_reference_scan  of every scan that a pair names
ScanPairs without_unlinked(const std::vector<PreparedScan>& scans, const PoseGraph& graph,
                           const std::vector<Eigen::Isometry3d>& T_reference_scan, ScanPairs pairs);

}  // namespace tcm_icp
