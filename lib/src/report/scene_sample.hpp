#pragma once
// Points for the 3D view and the pictures: a part of each scan, evenly over what it covers.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tcm_icp {

/// Of each scan, in its local frame (raw coordinates minus the scan's origin).
using ScenePoints = std::vector<std::vector<Eigen::Vector3f>>;

/// Takes points while scans stream by. Which are taken depends on their numbers within the scan alone.
class SceneSampler {
 public:
  /// @param num_points  of each scan that is to be seen; 0 for others
  /// @param wanted      of all scans together; each gets the same share, and what small ones leave goes to the others
  SceneSampler(const std::vector<std::uint64_t>& num_points, std::size_t wanted);

  /// The next points of a scan. @param origin  [m] that the local frame starts from
  void add(std::size_t scan, std::span<const Eigen::Vector3d> raw, const Eigen::Vector3d& origin);

  /// [m] Longest edge of the box about the points taken so far, as if all were in one frame.
  double extent_m() const;

  /// @param cell_m  of each scan, > 0: cubes that share points evenly among themselves, so that places near the
  ///                scanner do not take them all
  ScenePoints take(const std::vector<double>& cell_m, int num_threads);

 private:
  std::vector<std::size_t> share_;
  std::vector<std::uint64_t> seen_, limit_;  // hashes up to the limit are taken
  ScenePoints points_;
};

/// At most about `wanted` of the points, the same number from each cube that has so many. O(N log N).
std::vector<Eigen::Vector3f> even_over_cells(std::vector<Eigen::Vector3f> points, std::size_t wanted, double cell_m);

}  // namespace tcm_icp
