#include "pair_set.hpp"

#include <algorithm>

#include "pcl_search.hpp"
#include "tcm_icp/baselines/principal_axes.hpp"

namespace tcm_icp {

PairSet::PairSet(const std::vector<Points>& scans, double voxel_size_m) : scans_(scans), voxel_size_m_(voxel_size_m) {
  for (const auto& points : scans_) {
    indices_.emplace_back(points);
    const PclCloud::Ptr cloud = to_pcl(points, voxel_size_m);
    in_voxels_.push_back({cloud, index_of(*cloud)});
  }
}

void PairSet::measure(PairFit& fit) const {
  const Points& source = scans_[fit.source];
  const NeighborIndex& target = indices_[fit.target];
  fit.mean_distance_m = mean_nearest_distance(source, target, fit.T_target_source);
  const auto near = std::count_if(source.begin(), source.end(), [&](const Eigen::Vector3d& p) {
    return target.any_within(fit.T_target_source * p, kPartnerVoxels * voxel_size_m_);
  });
  fit.share = static_cast<double>(near) / static_cast<double>(std::min(source.size(), scans_[fit.target].size()));
}

void for_each_pair(const PairSet& set, const RunContext& context, const std::function<void(PairFit&)>& fit_pair) {
  const std::size_t n = set.size(), num_pairs = n * (n - 1) / 2;
  std::size_t done = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      context.report("aligning pairs", done++, num_pairs);
      PairFit fit;
      const bool first_is_smaller = set.points(i).size() <= set.points(j).size();
      fit.source = first_is_smaller ? i : j;
      fit.target = first_is_smaller ? j : i;
      fit_pair(fit);
    }
  }
}

}  // namespace tcm_icp
