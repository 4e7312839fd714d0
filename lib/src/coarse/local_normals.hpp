#pragma once
// Normals at the scale of the descriptors, from neighbourhoods that are known already.

#include "radius_neighbors.hpp"

namespace tcm_icp {

/// Principal axes of the neighbours within `radius_m`, of arbitrary sign; zero where there are too few, or they form a
/// line. Normals of the working cloud's resolution are too local: they follow each ring of a sparse scan.
/// @param neighbors  of at least that radius
Points local_normals(const Points& points, const RadiusNeighbors& neighbors, double radius_m);

}  // namespace tcm_icp
