#pragma once
// Hausdorff distance, which the paper compares its measure with (Eqs. 5 and 6). Squared, as it is printed there.

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// h(a, b) = max over a of the least squared distance to b [m^2], Eq. 6. Not symmetric.
/// @param num_threads  >= 1; changes speed only
/// @throws InvalidInput  if a cloud is empty or a coordinate is not finite
/// Cost O((N + M) log M).
double directed_hausdorff(const Points& a, const Points& b, int num_threads = 1);

/// H(a, b) = max(h(a, b), h(b, a)) [m^2], Eq. 5.
double hausdorff(const Points& a, const Points& b, int num_threads = 1);

}  // namespace tcm_icp
