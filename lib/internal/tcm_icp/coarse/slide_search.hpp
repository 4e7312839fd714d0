#pragma once
// Where else a scan may lie along a corridor, a street or a tunnel.

#include <cstddef>
#include <vector>

#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Whether the sign of a normal says which side of the surface was seen.
enum class NormalSides { kUnknown, kSeen };

/// What of a scan tells how far it slid.
struct SlideMarks {
  Cloud surfaces;  ///< with normals; a zero normal takes the point out
  Cloud borders;   ///< where surfaces end; as normals the directions in which they do; may be empty
  NormalSides sides = NormalSides::kUnknown;  ///< whether normals point to the side that was seen: then a wall's one
                                              ///< face does not vote with its other
};

/// Poses that differ from a given one by a slide along the direction in which the surfaces of both scans hold it least.
/// What looks the same all along a corridor fits best where two scans overlap most: with both scanners at one place,
/// not where they stood. Only surfaces across the direction tell, and borders, as of doors, that it crosses: each one
/// of the target and each one of the source that a slide would bring together vote for the length of that slide, and
/// lengths with more votes than those about them are candidates.
///
/// @param target           in its own frame
/// @param source           likewise
/// @param T_target_source  right but for a slide: heading to a degree, place across the slide to a voxel
/// @param voxel_m          > 0; spacing of both clouds
/// @return                 the most voted for first; the score is the votes beyond those of the lengths about, in
///                         standard deviations of their number; none within two voxels of the given pose
/// Cost: O(N) and the pairs of points of one voxel's width across the direction: some milliseconds for 10,000 points.
std::vector<PoseCandidate> slide_candidates(const SlideMarks& target, const SlideMarks& source,
                                            const Eigen::Isometry3d& T_target_source, double voxel_m,
                                            std::size_t max_candidates);

}  // namespace tcm_icp
