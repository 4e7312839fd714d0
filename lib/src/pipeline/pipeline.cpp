#include "tcm_icp/pipeline/pipeline.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "adjustment.hpp"
#include "link_verification.hpp"
#include "merged_cloud.hpp"
#include "placement.hpp"
#include "scan_set.hpp"
#include "stage_clock.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/tcm/merge_order.hpp"
#include "verdict.hpp"

namespace tcm_icp {
namespace {

std::size_t find_scan(const std::vector<std::filesystem::path>& paths, const std::string& name) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].filename() == name || paths[i] == name) return i;
  }
  throw InvalidOptions("--reference " + name + ": no scan of that name; it must be one of the files given");
}

class Run {
 public:
  Run(const PipelineOptions& options, const RunContext& context)
      : options_(options), context_(context), clock_(result_.stages) {}

  PipelineResult operator()(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses) {
    if (!options_.reference.empty()) asked_reference_ = find_scan(paths, options_.reference);
    clock_.begin("read and sample");
    read(paths);
    clock_.begin("prepare");
    prepare(initial_poses);
    clock_.begin("graph");
    build_graph();
    clock_.begin("merge");
    merge_scans();
    clock_.begin("adjust and verify");
    adjust_and_verify();
    clock_.end();
    report_poses();
    return std::move(result_);
  }

 private:
  bool paper() const { return options_.profile == Profile::kPaper; }

  void read(const std::vector<std::filesystem::path>& paths) {
    sampled_ = read_scans(paths, options_, context_);
    for (const auto& s : sampled_) result_.scans.push_back(summarize(s));
  }

  void prepare(const InitialPoses& initial_poses) {
    resolutions_ = choose_resolutions(sampled_, options_.sampling, context_.num_threads);
    result_.coarse_voxel_m = resolutions_.coarse_m;
    result_.fine_voxel_m = resolutions_.fine_m;
    T_init_ = initial_local_poses(initial_poses, sampled_);
    scans_ = prepare_scans(sampled_, resolutions_, options_.placement, context_);
  }

  void build_graph() {
    result_.graph = compare_scans(scans_, T_init_, options_, context_);
    result_.reference = asked_reference_.value_or(result_.graph.reference);
    result_.graph.reference = result_.reference;
  }

  void merge_scans() {
    const std::size_t n = scans_.size(), reference = result_.reference;
    T_reference_scan_.assign(n, Eigen::Isometry3d::Identity());
    placed_.assign(n, false);
    placed_[reference] = true;
    MergedCloud merged(resolutions_.coarse_m);
    merged.add(scans_[reference].pyramid.level(0).cloud, Eigen::Isometry3d::Identity());
    ScanPyramid target = merged.pyramid();

    std::vector<int> attempts(n, 0);
    std::vector<std::size_t> tried_at(n, 0);  // size of S, in scans, at the last attempt
    std::size_t num_merged = 1;
    bool last_round = false;
    while (true) {
      std::vector<MergeCandidate> candidates;
      for (std::size_t j = 0; j < n; ++j) {
        // A scan that failed is tried again once S has grown.
        if (!placed_[j] && tried_at[j] < num_merged && large_enough(j)) candidates.push_back({j, {}});
      }
      if (candidates.empty()) {
        // And at the end once more, since annealing draws other numbers each time; what it wins makes S grow.
        if (last_round || paper() || num_merged == 1) break;
        last_round = true;
        std::fill(tried_at.begin(), tried_at.end(), 0);
        continue;
      }
      context_.report("merging", num_merged, n);
      compute_tcm(target, candidates);
      const std::size_t q = next_scan_to_merge(candidates);
      MergeRecord record;
      record.scan = q;
      record.attempt = ++attempts[q];
      record.tcm =
          std::find_if(candidates.begin(), candidates.end(), [&](const auto& c) { return c.scan == q; })->terms;
      Rng rng = make_stream(context_.seed, "placement", sampled_[q].scan.file + "#" + std::to_string(record.attempt));
      const Eigen::Isometry3d T_init = T_init_[reference].inverse() * T_init_[q];
      const auto place = paper() ? place_scan_as_printed : place_scan;
      const Eigen::Isometry3d T = place(scans_[q], target, T_init, options_, rng, record);
      tried_at[q] = num_merged;
      if (record.accepted) {
        T_reference_scan_[q] = T;
        placed_[q] = true;
        merged.add(scans_[q].pyramid.level(0).cloud, T);
        target = merged.pyramid();
        ++num_merged;
        last_round = false;
      }
      context_.debug(sampled_[q].scan.file + (record.accepted ? " merged: " : " set aside: ") + record.reason);
      result_.merges.push_back(std::move(record));
    }
  }

  /// The measures need two points at the least, and so does a fit.
  bool large_enough(std::size_t scan) const {
    return std::min(scans_[scan].tcm_points.size(), scans_[result_.reference].tcm_points.size()) >= 2;
  }

  void compute_tcm(const ScanPyramid& merged, std::vector<MergeCandidate>& candidates) const {
    const std::size_t reference = result_.reference;
    if (paper()) {
      const TcmCloud s(merged.level(0).cloud.points);
      for (auto& c : candidates) {
        c.terms = tcm_terms(s, TcmCloud(scans_[c.scan].pyramid.level(0).cloud.points),
                            T_init_[reference].inverse() * T_init_[c.scan]);
      }
      return;
    }
    const RobustTcmCloud s(merged.level(1).cloud.points, options_.tcm);
    parallel_for(context_.num_threads, candidates.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const RobustTcmCloud cloud(scans_[candidates[k].scan].tcm_points, options_.tcm);
        candidates[k].terms = robust_tcm_terms(s, cloud, T_init_[reference].inverse() * T_init_[candidates[k].scan]);
      }
    });
  }

  // Poses move together, then each is judged again against all its neighbours: what a merge let pass does not pass
  // here. One scan at a time is taken out, the one that agrees least, because a wrong neighbour spoils the evidence of
  // right ones.
  void adjust_and_verify() {
    result_.evidence.assign(scans_.size(), std::nullopt);
    reasons_.assign(scans_.size(), "at the common resolution next to nothing is left of it, or of the reference");
    for (const auto& m : result_.merges) {
      result_.evidence[m.scan] = m.evidence;
      reasons_[m.scan] = m.reason;
    }
    while (true) {
      pairs_ = overlapping_pairs(scans_, T_reference_scan_, placed_, kMinLinkOverlap, context_.num_threads);
      if (paper()) break;
      adjust_poses(scans_, pairs_, result_.reference, resolutions_, options_.placement, context_, T_reference_scan_);
      const std::optional<std::size_t> worst = verify_placed();
      if (!worst) break;
      placed_[*worst] = false;
      context_.debug(sampled_[*worst].scan.file + " taken out again: " + reasons_[*worst]);
    }
    result_.links = verify_links(scans_, pairs_, T_reference_scan_, context_.num_threads);
  }

  /// Fills in the evidence of all placed scans; returns the one that agrees least among those that fail.
  std::optional<std::size_t> verify_placed() {
    context_.report("verifying", 0, 1);
    parallel_for(context_.num_threads, scans_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!placed_[i] || i == result_.reference) continue;
        const AlignmentEvidence at_merge = *result_.evidence[i];
        result_.evidence[i] = verify_against_neighbors(scans_, pairs_, i, T_reference_scan_);
        result_.evidence[i]->runner_up = at_merge.runner_up;  // what the scan's placement found out stays true
        result_.evidence[i]->searched = at_merge.searched;
      }
    });
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      if (!placed_[i] || i == result_.reference) continue;
      const Verdict verdict = judge(*result_.evidence[i]);
      reasons_[i] = verdict.reason;
      if (verdict.accepted) continue;
      if (!worst || result_.evidence[i]->consensus() < result_.evidence[*worst]->consensus()) worst = i;
    }
    return worst;
  }

  void report_poses() {
    int component = 0;
    const Eigen::Translation3d from_reference(sampled_[result_.reference].scan.origin);
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      ScanPose pose;
      pose.file = sampled_[i].scan.file;
      pose.reason = reasons_[i];
      if (i == result_.reference) {
        pose.status = ScanStatus::kReference;
        pose.verdict = "accepted";
        pose.reason = "the reference";
      } else if (placed_[i]) {
        pose.status = ScanStatus::kRegistered;
        pose.verdict = paper() ? "doubtful" : "accepted";
        // Raw coordinates to the reference's raw coordinates: both local origins are put back.
        pose.T_reference_scan = from_reference * T_reference_scan_[i] * Eigen::Translation3d(-sampled_[i].scan.origin);
      } else {
        pose.status = ScanStatus::kUnregistered;
        pose.component = ++component;
        pose.verdict = "rejected";
      }
      result_.poses.push_back(std::move(pose));
    }
  }

  const PipelineOptions& options_;
  const RunContext& context_;
  PipelineResult result_;
  StageClock clock_;
  std::vector<SampledScan> sampled_;
  std::optional<std::size_t> asked_reference_;
  Resolutions resolutions_;
  std::vector<PreparedScan> scans_;
  std::vector<Eigen::Isometry3d> T_init_;            // common frame of the initial poses <- local frame
  std::vector<Eigen::Isometry3d> T_reference_scan_;  // local frames
  std::vector<bool> placed_;
  std::vector<std::string> reasons_;  // of each scan's status
  ScanPairs pairs_;
};

}  // namespace

bool PipelineResult::all_registered() const {
  return std::none_of(poses.begin(), poses.end(),
                      [](const ScanPose& p) { return p.status == ScanStatus::kUnregistered; });
}

Pipeline::Pipeline(PipelineOptions options) : options_(std::move(options)) { options_.validate(); }

PipelineResult Pipeline::run(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses,
                             const RunContext& context) const {
  if (paths.size() < 2) {
    throw InvalidOptions("registration needs at least two scans, not " + std::to_string(paths.size()) +
                         "; name the files of all scans");
  }
  check_paths(paths, initial_poses);
  return Run(options_, context)(paths, initial_poses);
}

}  // namespace tcm_icp
