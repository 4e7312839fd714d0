#pragma once
// What a scan can say about free space: range images from where it was taken, and the sides of surfaces it saw.

#include <optional>
#include <vector>

#include "tcm_icp/visibility/range_image.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

struct Sight {
  /// The viewpoint and its alternatives; none where it is not even roughly determined.
  Points places;
  /// The same where it is not: a guess, to be weighed by what else bears it out. None where `places` has any.
  Points guessed_places;
  /// Whether the points lie on lines that were swept about the one place: what lies in one direction was seen at one
  /// time.
  bool swept = false;
  /// From these places; none where the viewpoint is not determined: such a scan does not judge others.
  std::vector<RangeImage> images;
  /// Normals of a cloud's points turned towards the scanner; zero where the point has none, or its side is not
  /// known. None without places.
  Points facing;

  bool sees_space() const { return !images.empty(); }
  bool knows_sides() const { return !places.empty(); }
  /// The side of a surface that the scanner was on: 1 where the normal points to, -1 away from it; 0 where that is not
  /// known, since the places do not agree.
  int side(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  /// The same, by guessed places where there are no others.
  int guessed_side(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
};

/// @param fine      the scan's points, as many as there are, for the images
/// @param surfaces  points with normals, for `facing`
Sight make_sight(const std::optional<Viewpoint>& viewpoint, const Points& fine, const Cloud& surfaces);

}  // namespace tcm_icp
