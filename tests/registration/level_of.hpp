#pragma once
// A resolution level of points as they are.

#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp::testing {

inline PyramidLevel level_of(const Cloud& cloud, double voxel_size_m = 0.1) { return {voxel_size_m, cloud}; }

}  // namespace tcm_icp::testing
