#include "registration/match_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace tcm_icp {

std::vector<std::vector<MatchId>> blocks_of(const std::vector<JointLink>& links, double edge_m) {
  using Cube = std::array<std::int64_t, 3>;
  std::vector<std::pair<Cube, MatchId>> placed;
  for (std::size_t l = 0; l < links.size(); ++l) {
    for (std::size_t m = 0; m < links[l].matches.size(); ++m) {
      Cube cube{};
      for (int axis = 0; axis < 3; ++axis) {
        cube[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>(std::floor(links[l].matches[m].source[axis] / edge_m));
      }
      placed.push_back({cube, {l, m}});
    }
  }
  std::stable_sort(placed.begin(), placed.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::vector<MatchId>> blocks;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (i == 0 || placed[i].first != placed[i - 1].first) blocks.emplace_back();
    blocks.back().push_back(placed[i].second);
  }
  return blocks;
}

}  // namespace tcm_icp
