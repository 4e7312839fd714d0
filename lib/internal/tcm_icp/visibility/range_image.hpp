#pragma once
// How far a scanner saw in each direction.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Ranges of a scan's points by bins of directions about one degree wide, as seen from one place.
class RangeImage {
 public:
  /// What a scan saw about one direction: in its bin and the eight around it.
  struct Surroundings {
    double least_m = 0, greatest_m = 0;  ///< [m] ranges
    int num_filled = 0;                  ///< bins with a point, 0 to 9
  };

  /// @param points  in the frame of `place`. O(N), about 10 ns a point.
  RangeImage(const Eigen::Vector3d& place, const Points& points);

  const Eigen::Vector3d& place() const { return place_; }

  /// @param direction  from the place; of length 1, so that its bin is the same in any unit
  Surroundings about(const Eigen::Vector3d& direction) const;

 private:
  // Single precision, half a megabyte: a scan may have several images, and a set a thousand scans.
  struct Bin {
    float least_m = 0, greatest_m = 0;
    std::uint8_t num_filled = 0;
  };

  Eigen::Vector3d place_;
  std::vector<Bin, PagedAllocator<Bin>> bins_;
};

}  // namespace tcm_icp
