#pragma once
// Lines that a scanner's beam swept over the surfaces, seen in the points alone.

#include <optional>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

/// Where the scanner stood that swept a scan's lines. Noise of ranges hides lines where it is no less than the distance
/// of points along them; but it moves points along their rays, so that from the right place, and near it, flat places
/// show them: there each point goes back along its ray to the plane. So a grid of places is searched for the one from
/// which most flat places show points in a row, and those lines tell the rest: a beam that turns about an axis at one
/// elevation draws a cone, and every piece of a line, of direction t at r from the centre, is at a right angle to
/// a x r x r, the normal of the plane that touches the cone, for one centre and one axis a (five unknowns):
/// t . (a |r|^2 - r (a . r)) = 0. Scanners with equal steps both ways leave rows up and down, too, in planes through
/// the axis; those speak neither for a place nor against it. Points that a grid has thinned show none.
/// @param cloud  the scan, with normals, for its extent
/// @param index  of the same points
/// @return       nothing where there are too few pieces of lines, where they do not agree on a centre, or on more than
///               one
/// Cost: 80 to 100 ms.
std::optional<Viewpoint> find_viewpoint_by_lines(const Cloud& cloud, const NeighborIndex& index, Rng& rng);

}  // namespace tcm_icp
