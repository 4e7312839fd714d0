#pragma once
// Where surfaces end and a scanner looked past them.

#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

/// Points of a scan's surfaces beside which the scan saw through, as beside a door or at a corner of a house: obstacle
/// borders (Steder et al., Point Feature Extraction on 3D Range Scans, 2011), from points instead of an image's
/// neighbours. As normals, unit vectors in the surface that point to where it ends.
/// @return  in the order of the points; none where the scan does not know where it was taken from, and on all sides of
///          points that are no surface. The bins of range images are a degree wide: only openings of three are seen.
/// Cost: eight looks at each image a point, and as many queries where one saw through.
Cloud find_borders(const SightedScan& scan);

}  // namespace tcm_icp
