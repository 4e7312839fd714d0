#include "tcm_icp/core/place_sampling.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

// The finalizer of SplitMix64 (Steele, Lea and Flood, 2014): a bijection in which every bit changes half the others.
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

auto by(std::span<const std::uint64_t> priorities) {
  return [priorities](std::size_t a, std::size_t b) { return std::tie(priorities[a], a) < std::tie(priorities[b], b); };
}

}  // namespace

std::vector<std::uint64_t> place_priorities(const Points& points, double voxel_size_m, Rng& rng) {
  const std::uint64_t salt = rng();
  std::vector<std::uint64_t> out;
  out.reserve(points.size());
  // One after the other: with the sum of the coordinates a salt would only shift the pattern.
  for (const auto& p : points) {
    const VoxelKey key = voxel_key(p, voxel_size_m);
    std::uint64_t hash = salt;
    for (const std::int64_t k : {key.x, key.y, key.z}) hash = mix(hash + static_cast<std::uint64_t>(k));
    out.push_back(hash);
  }
  return out;
}

std::vector<std::size_t> least_priorities(std::vector<std::size_t> indices, std::span<const std::uint64_t> priorities,
                                          std::size_t count) {
  if (indices.size() > count) {
    std::nth_element(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(count), indices.end(),
                     by(priorities));
    indices.resize(count);
  }
  std::sort(indices.begin(), indices.end());
  return indices;
}

std::vector<std::size_t> draw_order(std::span<const std::uint64_t> priorities) {
  std::vector<std::size_t> order(priorities.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), by(priorities));
  return order;
}

}  // namespace tcm_icp
