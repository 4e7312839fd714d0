#include <algorithm>

#include "pair_set.hpp"
#include "pcl_icp.hpp"
#include "pcl_methods.hpp"
#include "tcm_icp/baselines/principal_axes.hpp"

namespace tcm_icp {
namespace {

constexpr int kMaxIterations = 200;

}  // namespace

PairFits icp_pairs(const PairInput& input, const RunContext& context) {
  const PairSet set(input.scans, input.voxel_size_m);
  PairFits out;
  for_each_pair(set, context, [&](PairFit& fit) {
    const auto &T_source = input.T_init[fit.source], &T_target = input.T_init[fit.target];
    fit.T_target_source = T_source && T_target ? T_target->inverse() * *T_source
                                               : coarse_alignment_by_axes(set.points(fit.target), set.index(fit.target),
                                                                          set.points(fit.source));
    // Besl and McKay take all neighbours; what one scan alone has seen then pulls the pose away, so those nearby
    // follow.
    for (const double reach : {0.0, kIcpReachVoxels, kPartnerVoxels}) {
      icp_stage(set.in_voxels(fit.source).cloud, set.in_voxels(fit.target), set.voxel_size_m(), {reach, kMaxIterations},
                fit);
    }
    set.measure(fit);
    out.pairs.push_back(fit);
  });
  return out;
}

}  // namespace tcm_icp
