#include "linked_pairs.hpp"

#include <algorithm>

#include "link_search.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/graph/correspondence_graph.hpp"

namespace tcm_icp {
namespace {

bool bears_out(const PoseGraph& graph, std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b,
               const PreparedScan& scan_b) {
  const auto link = graph.links().find({a, b});
  if (link == graph.links().end()) return true;
  const double same_m = kSameLinkPose * scan_b.pyramid.level(0).voxel_size_m;
  return std::any_of(link->second.hypotheses.begin(), link->second.hypotheses.end(), [&](const LinkHypothesis& h) {
    return rms_displacement(T_a_b.inverse() * h.T_a_b, scan_b.moments) < same_m;
  });
}

}  // namespace

ScanPairs without_unlinked(const std::vector<PreparedScan>& scans, const PoseGraph& graph,
                           const std::vector<Eigen::Isometry3d>& T_reference_scan, ScanPairs pairs) {
  const auto n = static_cast<Eigen::Index>(scans.size());
  Eigen::MatrixXd measure = Eigen::MatrixXd::Ones(n, n);
  std::vector<bool> linked;
  for (const auto& pair : pairs) {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    linked.push_back(bears_out(graph, a, b, T_reference_scan[a].inverse() * T_reference_scan[b], scans[b]));
    const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
    if (linked.back()) measure(row, column) = measure(column, row) = 0;
  }
  const CorrespondenceGraph by_links = build_correspondence_graph(measure, 1.0);
  std::size_t k = 0;
  std::erase_if(pairs, [&](const auto& pair) {
    return !linked[k++] && by_links.component[pair.first] == by_links.component[pair.second];
  });
  return pairs;
}

}  // namespace tcm_icp
