#pragma once
// Which way is up in a scan whose frame may be turned anyhow.

#include <Eigen/Core>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// What scans of a levelled instrument are off the vertical at most, compensators that failed included.
constexpr double kMaxLevelTilt_deg = 10;

struct VerticalOptions {
  bool levelled = false;             ///< z points up in the scan's frame, within kMaxLevelTilt_deg
  int max_axes = 2;                  ///< >= 1; axes kept, each with one sign or both
  double min_area_ratio = 0.85;      ///< 0..1; an axis is kept where its ground plan is this large, by the largest
  double max_roughness_ratio = 0.8;  ///< 0..1; lower by upper envelope (or the reverse) for one sign alone to be kept
  void validate() const;             ///< throws InvalidOptions
};

/// Unit vectors of the scan's frame that may point up, the likeliest first; both signs of an axis where the data do not
/// show which is right. Up is the axis along which the scan covers the largest area, since ground, floors and treetops
/// spread sideways; below the ground there is nothing, so seen from below a scan is smooth. An object without a ground
/// has directions, too, that mean nothing. A levelled scan has one: z, or what floors near it say.
///
/// @param cloud  evenly sampled, at least 3 points; normals may be missing or zero
/// @throws InvalidInput  if the cloud is too small or all points are equal
/// Cost O(N); turns with the cloud.
std::vector<Eigen::Vector3d> find_up_directions(const Cloud& cloud, const VerticalOptions& options = {});

}  // namespace tcm_icp
