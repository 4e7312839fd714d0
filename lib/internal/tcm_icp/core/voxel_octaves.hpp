#pragma once
// The voxels that points occupy at an edge and at its doublings.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {

/// A voxel's place along Morton's curve: the code of the voxel of twice the edge around it is the same without the last
/// three bits, so that one sort tells which voxels are occupied at all edges.
using VoxelCode = std::uint64_t;

/// The voxels (voxel_key()) that points occupy at a fine edge, and at its doublings up to 2^19 times.
class VoxelOctaves {
 public:
  /// @param points    finite
  /// @param middle    [m] of them; what lies farther from it than 2^19 edges along an axis may count as lying nearer
  /// @param finest_m  > 0
  /// Cost O(N), but for the sort.
  VoxelOctaves(const Points& points, const Eigen::Vector3d& middle, double finest_m);

  double finest_m() const { return finest_m_; }
  const std::vector<VoxelCode>& finest() const { return codes_; }  ///< ascending, each once

  /// How many voxels are occupied at finest_m(), at twice that, and so on (box counting). Cost O(N) for all.
  std::vector<std::size_t> counts() const;

  /// The key of a voxel of 2^octave times finest_m().
  VoxelKey key(VoxelCode code, int octave) const;

 private:
  double finest_m_;
  VoxelKey first_;  ///< of the voxel with code 0
  std::vector<VoxelCode> codes_;
};

inline constexpr int kTouchingVoxels = 27;

/// The code of the n-th voxel, n < kTouchingVoxels, of those that touch a voxel, itself the middle one. At the border
/// of what codes can tell it is one at the opposite border.
VoxelCode touching_voxel(VoxelCode code, int n);

}  // namespace tcm_icp
