#pragma once
// FPFH of neighbourhoods that are known already.

#include "radius_neighbors.hpp"
#include "tcm_icp/coarse/fpfh.hpp"

namespace tcm_icp {

/// @param neighbors  within `radius_m`, of all points of the cloud
Descriptors fpfh(const Cloud& cloud, const RadiusNeighbors& neighbors, double radius_m);

}  // namespace tcm_icp
