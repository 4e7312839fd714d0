#include "tcm_icp/tcm/hausdorff.hpp"

#include <algorithm>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {

double directed_hausdorff(const Points& a, const Points& b, int num_threads) {
  if (a.empty() || b.empty()) throw InvalidInput("the Hausdorff distance of an empty cloud is not defined");
  const NeighborIndex index(b);
  std::vector<double> squared(a.size());
  parallel_for(num_threads, a.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!a[i].allFinite()) throw InvalidInput("a point of the Hausdorff distance is not finite");
      squared[i] = index.nearest(a[i]).squared_distance_m2;
    }
  });
  return *std::max_element(squared.begin(), squared.end());
}

double hausdorff(const Points& a, const Points& b, int num_threads) {
  return std::max(directed_hausdorff(a, b, num_threads), directed_hausdorff(b, a, num_threads));
}

}  // namespace tcm_icp
