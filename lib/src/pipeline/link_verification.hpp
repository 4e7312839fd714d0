#pragma once
// Every pair of placed scans that overlaps, judged by itself; and what follows for the scans.

#include <Eigen/Geometry>
#include <vector>

#include "adjustment.hpp"
#include "prepared_scan.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

/// Evidence for the pose of one scan against the union of its neighbours among the pairs.
AlignmentEvidence verify_against_neighbors(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                           std::size_t scan, const std::vector<Eigen::Isometry3d>& T_reference_scan);

/// Of each pair, in the pairs' order.
std::vector<FreeSpaceEvidence> free_space_of_pairs(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                                   const std::vector<Eigen::Isometry3d>& T_reference_scan,
                                                   int num_threads);

/// Of each scan, summed over the pairs it is in.
std::vector<FreeSpaceEvidence> free_space_of_neighbors(std::size_t num_scans, const ScanPairs& pairs,
                                                       const std::vector<FreeSpaceEvidence>& of_pairs);

/// One record a pair, in the pairs' order.
/// @param free_space  of the pairs, at the same poses
std::vector<LinkRecord> verify_links(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                     const std::vector<FreeSpaceEvidence>& free_space,
                                     const std::vector<Eigen::Isometry3d>& T_reference_scan, int num_threads);

}  // namespace tcm_icp
