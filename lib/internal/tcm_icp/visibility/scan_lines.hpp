#pragma once
// Lines that a scanner's beam swept over the surfaces, seen in the points alone.

#include <optional>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

/// Places where points lie in a row, much nearer to one another than to the next row.
struct LinePieces {
  Points middles;
  Points directions;  ///< unit length, the sign means nothing
};

/// Looks at up to 30,000 points and the four nearest of each. Points that a grid has thinned show none.
/// @param index  of the same points
/// Cost: a query of five neighbours a point, 30 ms.
LinePieces find_line_pieces(const Points& points, const NeighborIndex& index);

/// A beam that turns about an axis at one elevation draws a cone, and where it meets surfaces, lines. So every piece of
/// a line, of direction t at r from the centre, is at a right angle to a x r x r, the normal of the plane that touches
/// the cone, for one centre and one axis a (five unknowns): t . (a |r|^2 - r (a . r)) = 0. Surfaces may have any shape.
/// Searches a grid of centres, then fits the best by Gauss-Newton with Geman-McClure's weights.
/// @param cloud   the scan, with normals, for its extent
/// @param pieces  of the same scan
/// @return        nothing where there are too few pieces, where they do not agree on a centre, or on more than one
/// Cost: 50 to 100 ms.
std::optional<Viewpoint> find_viewpoint_by_lines(const Cloud& cloud, const LinePieces& pieces, Rng& rng);

}  // namespace tcm_icp
