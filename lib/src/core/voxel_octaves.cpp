#include "tcm_icp/core/voxel_octaves.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/sort/spreadsort/integer_sort.hpp>
#include <cstdint>

#include "tcm_icp/core/morton_code.hpp"

namespace tcm_icp {
namespace {

constexpr std::int64_t kHalfRange = std::int64_t{1} << (kMortonBits - 1);

VoxelCode code_along_axis(std::int64_t cell, std::int64_t first) {
  return morton_spread(static_cast<std::uint64_t>(std::clamp<std::int64_t>(cell - first, 0, 2 * kHalfRange - 1)));
}

// A multiple of 2^19, so that voxels of that many edges are those of the keys, too.
std::int64_t first_cell(std::int64_t middle) {
  constexpr int kAligned = kMortonBits - 2;
  return (middle - kHalfRange) >> kAligned << kAligned;
}

// One cell on or back along an axis whose bits are `mask`.
VoxelCode stepped(VoxelCode code, VoxelCode mask, int step) {
  const VoxelCode along = code & mask;
  if (step > 0) return (code & ~mask) | (((along | ~mask) + 1) & mask);
  if (step < 0) return (code & ~mask) | ((along - (mask & (~mask + 1))) & mask);
  return code;
}

}  // namespace

VoxelOctaves::VoxelOctaves(const Points& points, const Eigen::Vector3d& middle, double finest_m) : finest_m_(finest_m) {
  const VoxelKey around = voxel_key(middle, finest_m);
  first_ = {first_cell(around.x), first_cell(around.y), first_cell(around.z)};
  codes_.reserve(points.size());
  for (const auto& p : points) {
    const VoxelKey key = voxel_key(p, finest_m);
    codes_.push_back(code_along_axis(key.x, first_.x) | code_along_axis(key.y, first_.y) << 1 |
                     code_along_axis(key.z, first_.z) << 2);
  }
  boost::sort::spreadsort::integer_sort(codes_.begin(), codes_.end());
  codes_.erase(std::unique(codes_.begin(), codes_.end()), codes_.end());
}

std::vector<std::size_t> VoxelOctaves::counts() const {
  std::vector<std::size_t> out(kMortonBits - 1);
  if (codes_.empty()) return out;
  // Neighbours along the curve part at the edge where the highest bit differs.
  std::array<std::size_t, kMortonBits> parted{};
  for (std::size_t i = 1; i < codes_.size(); ++i) ++parted[(std::bit_width(codes_[i] ^ codes_[i - 1]) - 1) / 3];
  std::size_t count = codes_.size();
  for (std::size_t octave = 0; octave < out.size(); count -= parted[octave++]) out[octave] = count;
  return out;
}

VoxelKey VoxelOctaves::key(VoxelCode code, int octave) const {
  const auto along = [&](int axis, std::int64_t first) {
    return static_cast<std::int64_t>(morton_gathered(code >> axis)) + (first >> octave);
  };
  return {along(0, first_.x), along(1, first_.y), along(2, first_.z)};
}

VoxelCode touching_voxel(VoxelCode code, int n) {
  code = stepped(code, kMortonAxis, n % 3 - 1);
  code = stepped(code, kMortonAxis << 1, n / 3 % 3 - 1);
  return stepped(code, kMortonAxis << 2, n / 9 - 1);
}

}  // namespace tcm_icp
