#pragma once
// How densely points lie, which falls with the distance from the scanner.

#include <optional>
#include <span>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

/// Flat places of a scan, and the area of surface that a point has to itself there.
struct DensitySamples {
  Points points;
  Points normals;                ///< unit length, of the plane of the points around, the sign means nothing
  std::vector<double> log_area;  ///< logarithm of the area in m^2
};

/// Draws up to 3,000 points and takes the plane of the 24 nearest of each; edges and corners are left out.
/// @param counts  points of the scan that each of the points stands for
/// @param index   of the same points
/// Cost: a query of 25 neighbours a point, 10 to 20 ms.
DensitySamples sample_densities(const Points& points, std::span<const float> counts, const NeighborIndex& index,
                                Rng& rng);

/// A scanner with equal steps both ways, as those on tripods have, meets a surface at range r and angle of incidence
/// theta every s r along it, and every s r / cos(theta) the way it falls away; where it turns about an axis, every
/// s r cos(elevation) around it. Where points have been thinned to a spacing v, none is less than that. So the area of
/// a point is the product of the two, and the five unknowns are the place, s and v. Searches a grid of places, then
/// fits the best by Levenberg and Marquardt's method with a soft L1 loss, with steps that are equal on the sphere and
/// with each of three axes. The radius is three standard deviations by the jackknife over the octants about the place:
/// what the model has wrong shows there, too.
/// @param cloud    the scan, with normals, for its extent and for what hides there
/// @param samples  of the same scan
/// @return         nothing where the density does not follow the model closer than by chance of counting, where it
///                 does not tell the place, or where points are hidden from there
/// Cost: 20 to 50 ms.
std::optional<Viewpoint> find_viewpoint_by_density(const Cloud& cloud, const DensitySamples& samples, Rng& rng);

}  // namespace tcm_icp
