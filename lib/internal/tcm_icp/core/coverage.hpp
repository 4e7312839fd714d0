#pragma once
// The scale at which points cover the surfaces they lie on.

#include "tcm_icp/core/voxel_octaves.hpp"

namespace tcm_icp {

/// Voxel edge [m] below which points are lines or single points, and above which they cover surfaces: where the number
/// of occupied voxels begins to fall faster than that of points on lines does, by half for each doubling of the edge.
/// A spinning scanner's points are dense along a ring and far apart between rings: their spacing says nothing of it.
/// Counted at the edges of `voxels`, and interpolated between them. Scales with the points.
/// Isolated points (rain, birds, a sensor's faults) are one voxel each at any edge. Voxels are left out of an edge's
/// counts that have fewer than three others in the 6 x 6 x 6 around, where a line has six, if they are a tenth to six
/// tenths of all, and more than at half the edge.
/// @param voxels  at so fine an edge that points are lines or single points there
/// @return        0 where the points never cover anything: fewer than 64, or on a line
/// Cost O(N): coarser counts are taken over the finer ones' voxels.
double coverage_m(const VoxelOctaves& voxels);

}  // namespace tcm_icp
