#pragma once
// Where surfaces bend.

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// The twentieth of the points with the largest surface variation, at least one; sought among an even sample of
/// 100,000.
Points edges_and_corners(const Points& points, int num_threads);

}  // namespace tcm_icp
