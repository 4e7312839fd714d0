#pragma once
// From a heading and shift between two height maps to a pose in space.

#include "map_agreement.hpp"

namespace tcm_icp {

/// The pose of the source scan in the target scan's frame: levelling of both, heading and shift, then the offset and
/// tilt that bring the shared cells' heights together.
Eigen::Isometry3d lift_pose(const HeightMap& target, const HeightMap& source, const MapCells& cells,
                            const MapPeak& pose);

}  // namespace tcm_icp
