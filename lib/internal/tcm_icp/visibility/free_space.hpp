#pragma once
// A scan must not see through another's walls, nor both see one side of a wall from opposite sides.

#include <Eigen/Geometry>
#include <cstddef>

#include "tcm_icp/registration/scan_pyramid.hpp"
#include "tcm_icp/visibility/sight.hpp"

namespace tcm_icp {

/// What speaks against a pose. That nothing does, or that a scan has no viewpoint, speaks for none.
struct FreeSpaceEvidence {
  std::size_t num_points = 0;     ///< smooth points of one scan at surfaces the other saw, or before them
  std::size_t num_violating = 0;  ///< of these, before them: the other looked through
  std::size_t num_matches = 0;    ///< surfaces of both that meet, the side known that was seen of each
  std::size_t num_opposed = 0;    ///< of these, opposite sides
  std::size_t num_points_of_b = 0, num_violating_of_b = 0;  ///< of the former two, points of the second scan
  /// Of those before surfaces, what fills a square degree with the others about it, and of these the second scan's.
  /// What is smaller may stand between two rays.
  std::size_t num_large = 0, num_large_of_b = 0;

  double violation_share() const { return share(num_violating, num_points); }
  double opposed_share() const { return share(num_opposed, num_matches); }
  /// Whether enough points were looked at for violations to show: only then does it mean anything that there are none.
  bool tells() const;
  /// The larger of both shares in units of the most that noise, chance, or what moved between the scans, may make; 0
  /// where too few points tell.
  double excess() const;
  bool vetoes() const { return excess() > 1; }
  FreeSpaceEvidence& operator+=(const FreeSpaceEvidence& other);

 private:
  static double share(std::size_t part, std::size_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  }
};

constexpr std::size_t kFreeSpaceSample = 3000;  ///< points of either scan that are looked at

struct SightedScan {
  const PyramidLevel& surfaces;  ///< coarse voxel; `facing` is of these points
  const Sight& sight;
};

/// Both directions together; where a scan's images differ, the one with the least share of violations counts.
/// Cost: at most 3,000 points a direction, each a query and a look at up to seven images.
FreeSpaceEvidence measure_free_space(const SightedScan& a, const SightedScan& b, const Eigen::Isometry3d& T_a_b);

/// The same violations without the matches, whose counts stay 0: no queries, less than half the time.
/// @param max_points  of either scan
FreeSpaceEvidence measure_violations(const SightedScan& a, const SightedScan& b, const Eigen::Isometry3d& T_a_b,
                                     std::size_t max_points = kFreeSpaceSample);

}  // namespace tcm_icp
