#pragma once
// Where the graph of links is weakest, and what would help.

#include <cstddef>
#include <optional>
#include <vector>

namespace tcm_icp {

struct WeightedLink {
  std::size_t a = 0, b = 0;
  double weight = 0;  ///< >= 0
};

/// A part of the scans and the links that hold it to the others.
struct WeakSpot {
  std::vector<std::size_t> scans;  ///< the smaller part, ascending
  std::vector<std::size_t> links;  ///< positions, the strongest first
  double weight = 0;               ///< their sum
};

/// Parts that a single link holds (bridges), the weakest first; where there are none, the least cut of all (Stoer and
/// Wagner, 1997). Empty where the graph is not connected or has fewer than two nodes.
/// @param nodes  scans to look at; links with others are left out
/// Cost: O(nodes^3).
std::vector<WeakSpot> weak_spots(const std::vector<std::size_t>& nodes, const std::vector<WeightedLink>& links);

}  // namespace tcm_icp
