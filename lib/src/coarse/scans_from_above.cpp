#include "tcm_icp/coarse/scans_from_above.hpp"

#include <numeric>
#include <utility>

#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {

ScansFromAbove::ScansFromAbove(std::vector<const Cloud*> clouds, const VerticalOptions& vertical)
    : clouds_(std::move(clouds)), vertical_(vertical), footprints_(clouds_.size()) {
  vertical_.validate();
}

void ScansFromAbove::find(std::span<const std::size_t> scans, int num_threads) {
  parallel_for(num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Cloud& cloud = *clouds_[scans[k]];
      std::vector<Footprint>& footprints = footprints_[scans[k]];
      if (!footprints.empty()) continue;
      for (const auto& up : find_up_directions(cloud, vertical_)) {
        footprints.push_back(find_footprint(cloud.points, up));
      }
    }
  });
}

void ScansFromAbove::find_all(int num_threads) {
  std::vector<std::size_t> all(size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  find(all, num_threads);
}

}  // namespace tcm_icp
