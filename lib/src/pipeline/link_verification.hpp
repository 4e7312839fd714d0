#pragma once
// Every pair of placed scans that overlaps, judged by itself; and what follows for the scans.

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "prepared_scan.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// One record a pair, in the pairs' order.
std::vector<LinkRecord> verify_links(const std::vector<PreparedScan>& scans,
                                     const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                                     const std::vector<Eigen::Isometry3d>& T_reference_scan, int num_threads);

}  // namespace tcm_icp
