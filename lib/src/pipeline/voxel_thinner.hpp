#pragma once
// One point a voxel, of a stream of points.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tcm_icp {

/// Takes the first point of each voxel, whatever its place in it. Remembers 64-bit hashes of the voxels: two of n
/// voxels share one with a probability of n^2 / 2^65, one in a hundred thousand at 2^24 voxels, and then count as one.
/// Memory is 16 to 48 bytes a voxel.
class VoxelThinner {
 public:
  /// @param edge_m            [m] > 0, of the voxels, whose corners are at multiples of it
  /// @param part, num_parts   only voxels of this part are looked at, to bound the memory: each is of one part
  explicit VoxelThinner(double edge_m, std::uint64_t part = 0, std::uint64_t num_parts = 1);

  /// True for the first point of a voxel of the part. @throws InvalidOptions  if there are too many voxels to number
  bool takes(const Eigen::Vector3d& point);

  std::uint64_t num_voxels() const { return num_voxels_; }  ///< so far

 private:
  bool insert(std::uint64_t hash);
  void grow();

  double edge_m_;
  std::uint64_t part_, num_parts_;
  std::vector<std::uint64_t> hashes_;  ///< open addressing; 0 is a free place
  std::uint64_t num_voxels_ = 0;
};

}  // namespace tcm_icp
