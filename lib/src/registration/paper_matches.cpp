#include <algorithm>
#include <cmath>
#include <numeric>

#include "tcm_icp/registration/paper_registration.hpp"

namespace tcm_icp {
namespace {

// Keeps the matches of the least distances; equal ones in the order of the points.
void trim(double share, PaperMatchedPoints& matches) {
  const std::size_t n = matches.source.size();
  const auto kept = static_cast<std::size_t>(std::ceil(share * static_cast<double>(n)));
  if (kept >= n) return;
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return matches.distances[a] < matches.distances[b]; });
  order.resize(kept);
  std::sort(order.begin(), order.end());
  PaperMatchedPoints out;
  for (const std::size_t i : order) {
    out.source.push_back(matches.source[i]);
    out.target.push_back(matches.target[i]);
    out.distances.push_back(matches.distances[i]);
  }
  matches = std::move(out);
}

}  // namespace

PaperMatchedPoints paper_matches(const Points& source, const NeighborIndex& source_index, const Points& target,
                                 const NeighborIndex& target_index, const Eigen::Isometry3d& T_target_source,
                                 const PaperRegistrationOptions& options) {
  const PaperOptions& reading = options.reading;
  const Eigen::Isometry3d T_source_target = T_target_source.inverse();
  PaperMatchedPoints matches;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d moved = T_target_source * source[i];
    const Neighbor q = reading.matches == PaperMatches::kThreshold
                           ? target_index.nearest_within(moved, options.threshold_m)
                           : target_index.nearest(moved);
    if (!q.found()) continue;
    if (reading.matches == PaperMatches::kMutual &&
        source_index.nearest(T_source_target * target[q.index]).index != i) {
      continue;
    }
    matches.source.push_back(source[i]);
    matches.target.push_back(target[q.index]);
    matches.distances.push_back(std::sqrt(q.squared_distance_m2));
  }
  trim(reading.kept_share, matches);
  return matches;
}

}  // namespace tcm_icp
