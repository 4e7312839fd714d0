#pragma once
// The scans of a set as both methods need them, once each.

#include <functional>
#include <vector>

#include "pcl_icp.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

/// Points of the last correspondences, and of what counts as a partner, lie within so many voxels: neighbours on one
/// surface are at most 2 apart, the diagonal of a voxel being 1.7.
constexpr double kIcpReachVoxels = 4, kPartnerVoxels = 1.5;

/// Holds a reference to the points, which must outlive it.
class PairSet {
 public:
  PairSet(const std::vector<Points>& scans, double voxel_size_m);

  std::size_t size() const { return scans_.size(); }
  double voxel_size_m() const { return voxel_size_m_; }
  const Points& points(std::size_t scan) const { return scans_[scan]; }
  const NeighborIndex& index(std::size_t scan) const { return indices_[scan]; }
  /// In voxels.
  const PclTarget& in_voxels(std::size_t scan) const { return in_voxels_[scan]; }

  /// Mean distance and share of a fit.
  void measure(PairFit& fit) const;

 private:
  const std::vector<Points>& scans_;
  double voxel_size_m_;
  std::vector<NeighborIndex> indices_;
  std::vector<PclTarget> in_voxels_;
};

/// Calls `fit_pair` for every pair, the smaller scan being the source, and reports progress. @throws Cancelled
void for_each_pair(const PairSet& set, const RunContext& context, const std::function<void(PairFit&)>& fit_pair);

}  // namespace tcm_icp
