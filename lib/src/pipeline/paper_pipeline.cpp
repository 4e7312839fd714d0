// Algorithm 1 of the paper, line by line.

#include <algorithm>
#include <vector>

#include "adjustment/adjustment.hpp"
#include "decision/link_decision.hpp"
#include "links/measure_link.hpp"
#include "merging/fit_to_cloud.hpp"
#include "merging/merged_cloud.hpp"
#include "merging/tcm_order.hpp"
#include "pipeline/pipeline_input.hpp"
#include "pipeline/scan_set.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

ScanPose pose_of(std::size_t scan, std::size_t reference, const PipelineInput& in, const Eigen::Isometry3d& T,
                 const MergeRecord* record) {
  ScanPose pose;
  pose.file = in.files[scan];
  if (scan == reference) {
    pose.status = ScanStatus::kReference;
    pose.verdict = Verdict::kAccepted;
    pose.reason = "the reference";
  } else if (record != nullptr && record->accepted) {
    pose.status = ScanStatus::kRegistered;
    pose.verdict = Verdict::kDoubtful;  // this profile does not verify
    pose.reason = record->reason;
    pose.T_reference_scan = for_raw_coordinates(T, in.sampled[reference].scan, in.sampled[scan].scan);
  } else {
    pose.verdict = Verdict::kRejected;
    pose.reason = record != nullptr ? record->reason : "too few points to compare";
  }
  return pose;
}

// What verification would say of its links, for comparison; nothing follows from it.
void report_links(const std::vector<PreparedScan>& scans, const std::vector<Eigen::Isometry3d>& T,
                  const std::vector<bool>& merged, const RunContext& context, PipelineResult& result) {
  const SetReference usual = SetReference::of(result.coarse_voxel_m, 0, {});
  for (const auto& [a, b] : overlapping_pairs(scans, T, merged, kMinLinkOverlap, context.num_threads)) {
    result.links.push_back(judge_link(a, b, measure_link(scans[a], scans[b], T[a].inverse() * T[b]), usual));
  }
}

}  // namespace

void run_paper_pipeline(const PipelineInput& in, PipelineResult& result) {
  const std::size_t n = in.sampled.size();
  in.clock.begin("prepare");  // line 1, removal of outliers, was done as the scans were read
  const Resolutions resolutions = choose_resolutions(in.sampled, in.options.sampling, in.context.num_threads);
  result.coarse_voxel_m = resolutions.coarse_m;
  result.fine_voxel_m = resolutions.fine_m;
  const auto T_init = values_of(initial_local_poses(in.initial_poses, in.sampled, true));  // as they lie
  const auto scans = prepare_scans(in.sampled, resolutions, in.options.samples, in.context);

  in.clock.begin("link");  // lines 2 and 3: correspondence graph, reference
  result.graph = compare_scans(scans, T_init, in.options, in.context);
  const std::size_t reference = in.options.reference.empty() ? result.graph.reference : result.reference;
  result.reference = result.graph.reference = reference;

  in.clock.begin("merge");
  MergedCloud s(resolutions.coarse_m);
  s.add(scans[reference].pyramid.level(0).cloud, Eigen::Isometry3d::Identity());
  MergeOptions merging = in.options.merging();
  merging.correspondence_threshold_m = result.graph.threshold;
  TcmOrder order(scans, merging, in.context);
  std::vector<Eigen::Isometry3d> T(n, Eigen::Isometry3d::Identity());
  std::vector<bool> merged(n, false);
  merged[reference] = true;
  std::vector<MergeChoice> left;
  for (std::size_t j = 0; j < n; ++j) {
    const bool comparable =
        std::min(scans[j].pyramid.level(1).cloud.size(), scans[reference].pyramid.level(1).cloud.size()) > 1;
    if (j != reference && comparable) left.push_back({j, T_init[reference].inverse() * T_init[j]});
  }
  while (!left.empty()) {  // line 4
    in.context.report("merging", n - left.size(), n);
    const ScanPyramid cloud = s.pyramid();
    const auto measures = order.measure(cloud.level(order.level()), left);
    const std::size_t next = order.next(left, measures);  // line 5: the scan with the least tau, Eq. 1
    const MergeChoice q = left[next];
    MergeRecord record;
    record.scan = q.scan;
    record.tcm = measures[next].terms;
    Rng rng = make_stream(in.context.seed, "placement", scans[q.scan].key);
    T[q.scan] = place_scan_as_printed(scans[q.scan], cloud, q.T_reference_scan, merging, rng, record);  // 6, 7
    if (record.accepted) {
      s.add(scans[q.scan].pyramid.level(0).cloud, T[q.scan]);  // line 8
      merged[q.scan] = true;
    }
    in.context.debug(in.files[q.scan] + (record.accepted ? " merged: " : " set aside: ") + record.reason);
    result.merges.push_back(std::move(record));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
  }

  report_links(scans, T, merged, in.context, result);
  result.evidence.assign(n, std::nullopt);
  result.free_space.assign(n, {});
  for (std::size_t i = 0; i < n; ++i) {
    const MergeRecord* record = nullptr;
    for (const auto& r : result.merges) {
      if (r.scan == i) record = &r;
    }
    result.poses.push_back(pose_of(i, reference, in, T[i], record));
    int component = 0;
    if (result.poses[i].status == ScanStatus::kUnregistered) {
      for (const auto& p : result.poses) component = std::max(component, p.component + 1);
    }
    result.poses[i].component = component;
  }
}

}  // namespace tcm_icp
