#pragma once
// How far the points of two scans lie from each other's surfaces, and where they meet.

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// A point of one scan at a surface of another.
struct LinkResidual {
  bool of_b = false;                                ///< it is a point of the link's scan b, not of a
  float distance_m = 0;                             ///< from the plane of the other scan's surface, with its sign
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< [m] in the scan's local frame
};

/// A piece of surface that both scans of a link have many points on; walls before floors.
struct LinkContact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< [m] in the local frame of scan `a` of the link
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, either way
  std::size_t num_matches = 0;                        ///< of both directions
};

struct LinkResiduals {
  std::vector<LinkResidual> matches;
  std::optional<LinkContact> contact;  ///< none where there are no matches both ways
};

/// @param links    both directions of one pair of scans, matches in the common frame; the first one's target is `a`
/// @param T_common_scan  pose of each scan
/// @param cell_m   [m] > 0; edge of the cubes a contact is looked for in
/// Cost: O(matches log matches). Thread-safe.
LinkResiduals link_residuals(const std::vector<JointLink>& links, const std::vector<Eigen::Isometry3d>& T_common_scan,
                             double cell_m);

}  // namespace tcm_icp
