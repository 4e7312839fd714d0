#include "merging/merging.hpp"

#include <algorithm>
#include <string>

#include "merging/fit_to_cloud.hpp"
#include "merging/merged_cloud.hpp"
#include "merging/tcm_order.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

bool joined_to(const PairGraph& graph, std::size_t scan, const Component& component, const std::vector<bool>& merged) {
  for (const std::size_t k : graph.pairs_of(scan)) {
    const ComparedPair& pair = graph.pairs()[k];
    const std::size_t other = pair.a == scan ? pair.b : pair.a;
    if (!merged[other]) continue;
    if (graph.support(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]) > 0) return true;
  }
  return false;
}

}  // namespace

std::vector<MergeRecord> merge_in_tcm_order(const std::vector<PreparedScan>& scans, const PairGraph& graph,
                                            const MergeOptions& options, const RunContext& context,
                                            Component& component) {
  MergedCloud s(scans[component.reference].pyramid.level(0).voxel_size_m);
  s.add(scans[component.reference].pyramid.level(0).cloud, Eigen::Isometry3d::Identity());
  TcmOrder order(scans, options, context);
  std::vector<bool> merged(scans.size(), false);
  merged[component.reference] = true;
  const std::size_t count = component.size();
  std::vector<MergeRecord> records;
  while (records.size() + 1 < count) {
    context.report("merging", records.size() + 1, count);
    std::vector<MergeChoice> joined, left;
    for (const std::size_t i : component.members()) {
      if (merged[i]) continue;
      left.push_back({i, *component.T_reference_scan[i]});
      if (joined_to(graph, i, component, merged)) joined.push_back(left.back());
    }
    const std::vector<MergeChoice>& choices = joined.empty() ? left : joined;
    const ScanPyramid cloud = s.pyramid();
    const TcmOrder::Next next = order.next(cloud, choices);
    const std::size_t q = choices[next.position].scan;
    MergeRecord record;
    record.scan = q;
    record.tcm = next.terms;
    Rng rng = make_stream(context.seed, "placement", scans[q].key);
    const Eigen::Isometry3d& T_inferred = *component.T_reference_scan[q];
    const Eigen::Isometry3d T = fit_to_cloud(scans[q], cloud, T_inferred, options, rng, record);
    record.accepted = record.simplex.usable() && graph.same_pose(q, T_inferred, T);
    record.reason = record.accepted ? "fitted to what was merged before"
                    : record.simplex.usable()
                        ? "merged where its links lead: the fit to what was merged before leads elsewhere"
                        : "merged where its links lead: " + std::string(to_string(record.simplex.termination));
    if (record.accepted) component.T_reference_scan[q] = T;
    s.add(scans[q].pyramid.level(0).cloud, *component.T_reference_scan[q]);
    order.grown();
    merged[q] = true;
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace tcm_icp
