#pragma once
// How much scans share, from their true poses.

#include <Eigen/Core>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// (i, j): share of the points of clouds[i] that have a point of clouds[j] within 3 times the median point spacing of
/// clouds[j]. All clouds in one frame; an empty one shares nothing. Cost O(N log N) for each two
/// clouds of N points whose boxes meet, on `num_threads` threads, whose number does not change the result.
/// @throws InvalidInput  if a coordinate is not finite
Eigen::MatrixXd overlap_matrix(const std::vector<Points>& clouds, int num_threads);

}  // namespace tcm_icp
