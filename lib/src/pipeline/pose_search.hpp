#pragma once
// Other poses worth a fit: along the directions a scan can be shifted most freely, and by annealing from a poor guess.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

/// Distance between the grid points of other_minima, in coarse voxels. Poses nearer than half of it are the same.
constexpr double kSearchGridStep = 4;

/// Up to three local minima of the alignment cost over a grid of 13 x 13 poses around T, lowest first, T's own left
/// out. The grid lies in the plane of the two weakest translations: eigenvectors of the sum of n n' over the normals of
/// `surfaces`.
/// @param points  a sample of every kind of point, for the cost
/// Cost: 169 evaluations over 200 points.
std::vector<Eigen::Isometry3d> other_minima(const Cloud& points, const Cloud& surfaces, const ScanPyramid& merged,
                                            const Eigen::Isometry3d& T);

/// Annealing over the twist from T_init, first steps of eight coarse voxels: a pose to start the linear programs from
/// where the initial guess is too far off. `held_out` decides whether anything was won; otherwise T_init comes back.
Eigen::Isometry3d search_by_annealing(const Cloud& points, const Cloud& held_out, const ScanPyramid& merged,
                                      const Eigen::Isometry3d& T_init, const PipelineOptions& options, Rng& rng);

}  // namespace tcm_icp
