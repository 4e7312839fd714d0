#pragma once
// Voxel-sampled copies of a cloud, fine to coarse, each searchable.

#include <cstddef>
#include <optional>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/grid_index.hpp"

namespace tcm_icp {

/// One resolution: cloud with normals, and what finds neighbours a few voxels away.
struct PyramidLevel {
  /// @param voxel_size_m  > 0
  /// @throws InvalidInput  if a point is not finite
  PyramidLevel(double voxel_size_m, Cloud cloud);

  double voxel_size_m;
  Cloud cloud;
  GridIndex index;
};

/// Voxel edges double from level to level; level 0 is the finest. The levels of all scans of a set have the same edges,
/// so that what is coarse for one is coarse for all.
class ScanPyramid {
 public:
  /// @param cloud             with normals [m]
  /// @param finest_voxel_m    > 0
  /// @param num_levels        >= 1
  ScanPyramid(const Cloud& cloud, double finest_voxel_m, std::size_t num_levels);

  const PyramidLevel& level(std::size_t i) const { return levels_[i]; }
  std::size_t num_levels() const { return levels_.size(); }

  /// The coarsest level whose voxels are not larger than `size_m`, but for rounding; the finest where all are.
  const PyramidLevel& level_for(double size_m) const;

 private:
  std::vector<PyramidLevel> levels_;
};

/// Voxel edge [m] at which the points occupy about `num_voxels` voxels, or half as many as there are points where that
/// is fewer, to a sixteenth of an octave. Voxels are counted, because the spacing along a scan line says little about
/// the area a scan covers. O(N) a count, about three counts and a sort.
/// @throws InvalidInput  if all points are equal
double voxel_size_for(const Points& points, std::size_t num_voxels);

}  // namespace tcm_icp
