#include "merging/merging.hpp"

#include <optional>
#include <string>

#include "merging/fit_to_cloud.hpp"
#include "merging/merged_scans.hpp"
#include "merging/tcm_order.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

// Those first that hypotheses join to what is merged.
std::vector<MergeChoice> choices_of(const MergedScans& s, const Component& component) {
  std::vector<MergeChoice> joined, left;
  for (const std::size_t i : component.members()) {
    if (s.has(i)) continue;
    (s.joins(i) ? joined : left).push_back({i, s.pose(i)});
  }
  return joined.empty() ? left : joined;
}

Eigen::Isometry3d place(const PreparedScan& scan, const Eigen::Isometry3d& T_inferred, const MergedScans& s,
                        const PairGraph& graph, const MergeOptions& options, const RunContext& context,
                        MergeRecord& record) {
  if (!options.fits) {
    record.accepted = true;
    record.reason = "merged where inference puts it, from where the joint adjustment starts";
    return T_inferred;
  }
  const Eigen::Isometry3d T_start = s.pose(record.scan);
  Rng rng = make_stream(context.seed, "placement", scan.key);
  const Eigen::Isometry3d T = fit_to_cloud(scan, s.near(record.scan), T_start, options, rng, record);
  record.accepted = record.simplex.usable() && graph.same_pose(record.scan, T_start, T);
  record.reason = record.accepted ? "fitted to what was merged before"
                  : record.simplex.usable()
                      ? "merged where its links lead: the fit to what was merged before leads elsewhere"
                      : "merged where its links lead: " + std::string(to_string(record.simplex.termination));
  return record.accepted ? T : T_start;
}

}  // namespace

std::vector<MergeRecord> merge_in_tcm_order(const std::vector<PreparedScan>& scans, const PairGraph& graph,
                                            const MergeOptions& options, const RunContext& context,
                                            Component& component) {
  MergedScans s(scans, graph, component);
  s.add(component.reference, *component.T_reference_scan[component.reference]);
  TcmOrder order(scans, options, context);
  std::vector<std::optional<MergeMeasure>> measures(scans.size());  // of those whose part of S is as it was then
  const std::size_t count = component.size();
  std::vector<MergeRecord> records;
  while (records.size() + 1 < count) {
    context.report("merging", records.size() + 1, count);
    const std::vector<MergeChoice> choices = choices_of(s, component);
    parallel_for(context.num_threads, choices.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        auto& measure = measures[choices[k].scan];
        const bool known = measure && s.joins(choices[k].scan);  // what nothing joins meets what is nearest by now
        if (!known) measure = order.measure(s.near(choices[k].scan, order.level()), {choices[k]}).front();
      }
    });
    std::vector<MergeMeasure> measured;
    for (const MergeChoice& choice : choices) measured.push_back(*measures[choice.scan]);
    const std::size_t q = choices[order.next(choices, measured)].scan;
    MergeRecord record;
    record.scan = q;
    record.tcm = measures[q]->terms;
    const Eigen::Isometry3d T = place(scans[q], *component.T_reference_scan[q], s, graph, options, context, record);
    for (const std::size_t i : s.add(q, T)) measures[i].reset();
    records.push_back(std::move(record));
  }
  component = s.component();
  return records;
}

}  // namespace tcm_icp
