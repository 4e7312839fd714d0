#include "evaluation/edges_and_corners.hpp"

#include <algorithm>
#include <numeric>

#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/normals.hpp"

namespace tcm_icp {

Points edges_and_corners(const Points& points, int num_threads) {
  constexpr double kShare = 0.05;
  constexpr std::size_t kSample = 100000;
  const Points sample = even_sample(points, kSample);
  const auto estimate = estimate_normals(sample, NeighborIndex(sample), {}, num_threads);
  std::vector<std::size_t> order(sample.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return estimate.variation[a] > estimate.variation[b]; });
  order.resize(std::max<std::size_t>(1, static_cast<std::size_t>(kShare * static_cast<double>(order.size()))));
  Points features;
  for (const std::size_t i : order) features.push_back(sample[i]);
  return features;
}

}  // namespace tcm_icp
