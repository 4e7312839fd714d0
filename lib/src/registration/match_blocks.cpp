#include "registration/match_blocks.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace tcm_icp {

std::vector<std::vector<MatchId>> blocks_of(const std::vector<JointLink>& links, double edge_m) {
  std::map<std::array<std::int64_t, 3>, std::vector<MatchId>> cubes;
  for (std::size_t l = 0; l < links.size(); ++l) {
    for (std::size_t m = 0; m < links[l].matches.size(); ++m) {
      std::array<std::int64_t, 3> cube{};
      for (int axis = 0; axis < 3; ++axis) {
        cube[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>(std::floor(links[l].matches[m].source[axis] / edge_m));
      }
      cubes[cube].push_back({l, m});
    }
  }
  std::vector<std::vector<MatchId>> blocks;
  blocks.reserve(cubes.size());
  for (auto& [cube, members] : cubes) blocks.push_back(std::move(members));
  return blocks;
}

}  // namespace tcm_icp
