#pragma once
// The rigid motion that takes points to points, by least squares.

#include <Eigen/Geometry>
#include <span>

#include "compatibility_graph.hpp"

namespace tcm_icp {

/// Weighted least squares over the listed matches (Kabsch, Umeyama); identity where there are none.
/// @param weights  one for each listed match, >= 0; empty: all equal
Eigen::Isometry3f fit_rigid(const MatchedPoints& matches, std::span<const std::uint32_t> listed,
                            std::span<const float> weights);

}  // namespace tcm_icp
