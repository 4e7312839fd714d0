#include "merging/merged_scans.hpp"

#include <algorithm>

#include "merging/merged_cloud.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

// Those it overlaps most with show a scan what S is there; others repeat it.
constexpr std::size_t kMostNeighbors = 8;

}  // namespace

MergedScans::MergedScans(const std::vector<PreparedScan>& scans, const PairGraph& graph, const Component& inferred)
    : scans_(scans),
      graph_(graph),
      inferred_(inferred),
      component_(inferred),
      merged_(scans.size(), false),
      neighbors_(scans.size()) {}

Eigen::Isometry3d MergedScans::pose(std::size_t scan) const {
  if (merged_[scan]) return *component_.T_reference_scan[scan];
  const Eigen::Isometry3d& T_inferred = *inferred_.T_reference_scan[scan];
  if (!joins(scan)) return T_inferred;
  const std::size_t neighbor = neighbors_[scan].front().scan;
  return *component_.T_reference_scan[neighbor] * inferred_.T_reference_scan[neighbor]->inverse() * T_inferred;
}

std::vector<std::size_t> MergedScans::add(std::size_t scan, const Eigen::Isometry3d& T_reference_scan) {
  component_.T_reference_scan[scan] = T_reference_scan;
  merged_[scan] = true;
  const auto& T = inferred_.T_reference_scan;
  std::vector<std::size_t> out;
  for (const std::size_t k : graph_.pairs_of(scan)) {
    const ComparedPair& pair = graph_.pairs()[k];
    const std::size_t other = pair.a == scan ? pair.b : pair.a;
    if (merged_[other] || !component_.has(other)) continue;
    if (graph_.support(pair, *T[pair.a], *T[pair.b]) <= 0) continue;
    const PyramidLevel &a = scans_[scan].pyramid.level(2), &b = scans_[other].pyramid.level(2);
    const double share = overlap(a, b, T[scan]->inverse() * *T[other], 2 * a.voxel_size_m);
    std::vector<Neighbor>& neighbors = neighbors_[other];
    neighbors.push_back({share, scan});
    std::stable_sort(neighbors.begin(), neighbors.end(),
                     [](const Neighbor& x, const Neighbor& y) { return x.overlap > y.overlap; });
    out.push_back(other);
  }
  return out;
}

std::vector<std::size_t> MergedScans::neighbors_of(std::size_t scan) const {
  std::vector<std::size_t> out;
  for (const Neighbor& n : neighbors_[scan]) out.push_back(n.scan);
  if (out.empty()) {
    const auto& T = component_.T_reference_scan;
    const Eigen::Vector3d middle = pose(scan) * scans_[scan].moments.mean;
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t i = 0; i < merged_.size(); ++i) {
      if (merged_[i]) nearest.emplace_back((*T[i] * scans_[i].moments.mean - middle).squaredNorm(), i);
    }
    std::sort(nearest.begin(), nearest.end());
    for (const auto& [squared_m2, i] : nearest) out.push_back(i);
  }
  if (out.size() > kMostNeighbors) out.resize(kMostNeighbors);
  return out;
}

PyramidLevel MergedScans::near(std::size_t scan, std::size_t level) const {
  MergedCloud cloud(scans_[scan].pyramid.level(level).voxel_size_m);
  for (const std::size_t i : neighbors_of(scan)) {
    cloud.add(scans_[i].pyramid.level(level).cloud, *component_.T_reference_scan[i]);
  }
  return cloud.level();
}

ScanPyramid MergedScans::near(std::size_t scan) const {
  MergedCloud cloud(scans_[scan].pyramid.level(0).voxel_size_m);
  for (const std::size_t i : neighbors_of(scan)) {
    cloud.add(scans_[i].pyramid.level(0).cloud, *component_.T_reference_scan[i]);
  }
  return cloud.pyramid();
}

}  // namespace tcm_icp
