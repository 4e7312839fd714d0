#pragma once
// A bounded sample without random numbers: evenly spaced in the order of the points.

#include <cstddef>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// At most `max_count` of the points, evenly spaced in their order: point floor(i N / count) for i = 0, 1, ... All of
/// them where N <= max_count. O(max_count).
Points even_sample(const Points& points, std::size_t max_count);

/// The same of a cloud, normals with their points.
Cloud even_sample(const Cloud& cloud, std::size_t max_count);

}  // namespace tcm_icp
