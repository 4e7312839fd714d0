#include "registration/match_blocks.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "core/voxel_table.hpp"

namespace tcm_icp {

std::vector<std::vector<MatchId>> blocks_of(const std::vector<JointLink>& links, double edge_m) {
  VoxelTable cubes;
  std::vector<std::uint32_t> cube_of, size;
  for (const auto& link : links) {
    for (const auto& match : link.matches) {
      cube_of.push_back(cubes.find_or_insert(voxel_key(match.source, edge_m)));
      if (cube_of.back() == size.size()) size.push_back(0);
      ++size[cube_of.back()];
    }
  }
  // By place, so that the order of the scans does not decide in which order sums are taken.
  std::vector<std::uint32_t> order(size.size()), rank(size.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t cube) {
    const VoxelKey& key = cubes.keys()[cube];
    return std::tie(key.x, key.y, key.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  std::vector<std::vector<MatchId>> blocks(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    rank[order[k]] = k;
    blocks[k].reserve(size[order[k]]);
  }
  std::size_t next = 0;
  for (std::size_t l = 0; l < links.size(); ++l) {
    for (std::size_t m = 0; m < links[l].matches.size(); ++m) blocks[rank[cube_of[next++]]].push_back({l, m});
  }
  return blocks;
}

}  // namespace tcm_icp
