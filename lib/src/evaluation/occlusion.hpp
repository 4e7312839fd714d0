#pragma once
// Which points of a scan something would hide.

#include <cstddef>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

/// All but `num_hidden` of the points: two sectors about the vertical through their mean, and two boxes about random
/// places of the scan, hide a quarter of them each and are as wide as that asks for.
std::vector<bool> visible_points(const Points& points, std::size_t num_hidden, Rng& rng);

}  // namespace tcm_icp
