#pragma once
// Whether a scanner looked through a place.

#include <Eigen/Core>

#include "tcm_icp/visibility/range_image.hpp"

namespace tcm_icp {

enum class Seen { kNothing, kThrough, kAt, kBefore };

/// What a scan saw of a point: it looked through there, at a surface there, or at one before it; or nothing there.
/// @param voxel_m  of the points compared; nearer than that, and than what viewpoint and bins leave open, all is one
inline Seen seen_at(const RangeImage& image, const Eigen::Vector3d& point, double voxel_m) {
  // Clearly before a surface: a coarse voxel, and what the viewpoint and a bin's width leave open.
  constexpr double kClearOfVoxel = 1, kClearOfRange = 0.03;
  constexpr int kMinFilled = 4;  // two lines of a scanner at least: what is seen must be a surface, not a leaf
  const Eigen::Vector3d ray = point - image.place();
  const double range = ray.norm();
  const RangeImage::Surroundings seen = image.about(ray / range);
  if (seen.num_filled < kMinFilled) return Seen::kNothing;
  const double clear_m = kClearOfVoxel * voxel_m + kClearOfRange * range;
  if (range < seen.least_m - clear_m) return Seen::kThrough;
  return range <= seen.greatest_m + clear_m ? Seen::kAt : Seen::kBefore;
}

}  // namespace tcm_icp
