#pragma once
// Which target point each source point is taken to be, under a pose.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

/// One matched pair in the target's frame.
struct Correspondence {
  Eigen::Vector3d source;  ///< the source point, moved by the pose [m]
  Eigen::Vector3d target;  ///< its nearest target point [m]
  Eigen::Vector3d normal;  ///< unit normal of the plane between them
  double agreement = 0;    ///< |cosine| of the angle between the normals of both points; 0 where one has none
  double precision = 1;    ///< what the residual is multiplied by before it is weighed; 1: as good as any other
};

/// Those of a pair; of all pairs of a large set they are what a joint adjustment needs most memory for.
using Correspondences = std::vector<Correspondence, PagedAllocator<Correspondence>>;

struct CorrespondenceGate {
  double max_distance_m = 0;          ///< [m] > 0; farther pairs are dropped
  double max_normal_angle_rad = 1.0;  ///< [rad] pairs whose normals differ more are dropped
};

/// Nearest neighbours of the moved source points that pass the gate; in the order of the source. The plane's normal is
/// the target's; the source's where the target has none. O(N log M).
Correspondences find_correspondences(const Cloud& source, const Eigen::Isometry3d& T_target_source,
                                     const PyramidLevel& target, const CorrespondenceGate& gate);

}  // namespace tcm_icp
