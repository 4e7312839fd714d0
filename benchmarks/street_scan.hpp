#pragma once
// What a spinning LiDAR sees of a made-up street: the same points for every library that is compared.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Exactly `count` points of a scan from `T_world_scanner`, in the scanner's frame [m], in firing order. The street
/// (ground, houses, cars, poles, made of planes) is always the same; ranges up to 80 m carry noise of 1 cm, seeded by
/// `seed`. O(count) and about a hundred box intersections a ray.
Points street_scan(const Eigen::Isometry3d& T_world_scanner, std::size_t count, std::uint64_t seed);

}  // namespace tcm_icp
