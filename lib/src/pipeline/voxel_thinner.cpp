#include "pipeline/voxel_thinner.hpp"

#include <cmath>
#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kFirstSize = 1024;  // a power of two, like all that follow

/// The last step of SplitMix64: every bit of the result depends on every bit of `x`.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

}  // namespace

VoxelThinner::VoxelThinner(double edge_m, std::uint64_t part, std::uint64_t num_parts)
    : edge_m_(edge_m), part_(part), num_parts_(num_parts), hashes_(kFirstSize, 0) {}

bool VoxelThinner::takes(const Eigen::Vector3d& point) {
  constexpr double kLargest = 9e15;  // whole numbers are exact in a double up to here
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor(point[axis] / edge_m_);
    if (!(std::abs(index) < kLargest)) {
      throw InvalidOptions("the edge of voxels, " + std::to_string(edge_m_) +
                           ", is too small for coordinates as large as these; give a larger --voxel");
    }
    hash = mixed(hash + 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(static_cast<std::int64_t>(index)));
  }
  if ((hash >> 32U) % num_parts_ != part_) return false;
  return insert(hash == 0 ? 1 : hash);
}

bool VoxelThinner::insert(std::uint64_t hash) {
  if (3 * (num_voxels_ + 1) > 2 * hashes_.size()) grow();
  const std::size_t mask = hashes_.size() - 1;
  std::size_t at = hash & mask;
  while (hashes_[at] != 0) {
    if (hashes_[at] == hash) return false;
    at = (at + 1) & mask;
  }
  hashes_[at] = hash;
  ++num_voxels_;
  return true;
}

void VoxelThinner::grow() {
  std::vector<std::uint64_t> old(2 * hashes_.size(), 0);
  old.swap(hashes_);
  num_voxels_ = 0;
  for (const std::uint64_t hash : old) {
    if (hash != 0) insert(hash);
  }
}

}  // namespace tcm_icp
