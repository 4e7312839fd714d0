#pragma once
// PCL's registrations behind one face; built only where PCL is found.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// One call of align() for each of `gates_m`, the largest correspondence distance [m], from the result of the one
/// before. At most 100 iterations a gate; ICP stops at steps below 0.1 mm or when the mean squared error changes by
/// less than a millionth of itself. The tree of the target is built within the call.
Eigen::Isometry3d pcl_icp(const Points& source, const Points& target, const Eigen::Isometry3d& T_init,
                          const std::vector<double>& gates_m);

/// The same with PCL's linear least squares to the planes of the target's normals. Points without a normal are left
/// out.
Eigen::Isometry3d pcl_point_to_plane(const Cloud& source, const Cloud& target, const Eigen::Isometry3d& T_init,
                                     const std::vector<double>& gates_m);

/// Generalized ICP; its covariances come from 20 neighbours, PCL's default, and are computed within the call.
/// @param smallest_step  [m] and [rad] it stops at steps below; 0 for PCL's defaults (0.5 mm, 2 mrad)
Eigen::Isometry3d pcl_gicp(const Points& source, const Points& target, const Eigen::Isometry3d& T_init,
                           const std::vector<double>& gates_m, double smallest_step);

}  // namespace tcm_icp
