#pragma once
// The direction in which surfaces hold two scans least.

#include <Eigen/Geometry>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Columns: the direction in the target's frame along which the surfaces of both scans lie, then two across it. Doors
/// and furniture at an angle do not turn it: by a degree it would lead a decimetre astray over six metres.
/// @param target_normals, source_normals  of length 1, in the frames of their scans; zero takes one out. Either scan
///                                        counts the same
/// Cost: five passes.
Eigen::Matrix3d slide_axes(const Points& target_normals, const Points& source_normals,
                           const Eigen::Matrix3d& R_target_source);

}  // namespace tcm_icp
