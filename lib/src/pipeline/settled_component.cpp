#include "pipeline/settled_component.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "adjustment/adjustment.hpp"
#include "adjustment/uncertainty.hpp"
#include "decision/link_decision.hpp"
#include "inference/configuration.hpp"
#include "inference/cuts.hpp"
#include "links/measure_link.hpp"
#include "pipeline/leaving_scans.hpp"
#include "pipeline/measured_scan.hpp"
#include "pipeline/scan_set.hpp"
#include "pipeline/solve_steps.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

constexpr double kUnmovedInVoxels = 0.01;  // fine ones, which are larger than the noise
constexpr int kMaxRounds = 3;              // of moves to likelier places

struct MeasuredAt {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  LinkMeasurements measurements;
};

class Settling {
 public:
  Settling(const std::vector<PreparedScan>& scans, const HypothesisSet& hypotheses, const PairGraph& graph,
           const Resolutions& resolutions, const PipelineOptions& options, const RunContext& context,
           Component component, const StepStore* steps)
      : scans_(scans),
        hypotheses_(hypotheses),
        graph_(graph),
        resolutions_(resolutions),
        options_(options),
        context_(context),
        steps_(steps) {
    out_.component = std::move(component);
    out_.measurements.resize(scans.size());
    out_.decisions.resize(scans.size());
  }

  SettledComponent run() {
    for (bool is_whole = true;; is_whole = false) {
      adjust();
      // Where scans have left, what they said of the others is not in the likelihood any more: a place that is likelier
      // now was less likely by all evidence. It counts against the lead.
      if (is_whole) adjust_likelier();
      // Before anything is judged: a decision is about where a scan lies to the reference.
      if (options_.reference.empty()) choose_best_reference();
      if (is_whole) take_pairs_back();
      measure();
      const std::vector<std::size_t> dropped = decide_members();
      context_.debug(std::to_string(dropped.size()) + " of " + std::to_string(out_.component.size()) +
                     " adjusted scans are set aside");
      if (dropped.empty()) break;
      for (const std::size_t i : dropped) out_.component.T_reference_scan[i].reset();
      if (!out_.component.has(out_.component.reference)) choose_another_reference();
    }
    return std::move(out_);
  }

 private:
  std::vector<Eigen::Isometry3d> poses() const {
    std::vector<Eigen::Isometry3d> T;
    for (const auto& pose : out_.component.T_reference_scan) T.push_back(pose.value_or(Eigen::Isometry3d::Identity()));
    return T;
  }

  std::vector<bool> membership() const {
    std::vector<bool> out;
    for (const auto& pose : out_.component.T_reference_scan) out.push_back(pose.has_value());
    return out;
  }

  void adjust() {
    std::vector<Eigen::Isometry3d> T = poses();
    overlapping_ = overlapping_pairs(scans_, T, membership(), kMinLinkOverlap, context_.num_threads);
    out_.pairs = hypotheses_.without_unlikely(overlapping_, T, there_);
    out_.adjustment = adjust_once(steps_, scans_, out_.pairs, out_.component.reference, resolutions_,
                                  options_.adjustment, options_.lp, context_, T, poses_are_);
    poses_are_ = StartingPoses::kAdjusted;
    for (const std::size_t i : out_.component.members()) out_.component.T_reference_scan[i] = T[i];
  }

  // Pairs that were left out are adjusted, too, where they are likelier right than wrong by what they show at the poses
  // that the others have. Once: what that brings back moves poses little.
  void take_pairs_back() {
    const std::vector<Eigen::Isometry3d> T = poses();
    measure_links(T);
    if (hypotheses_.without_unlikely(overlapping_, T, there_) != out_.pairs) adjust();
  }

  // Adjusted poses are closer to what is right than those of the hypotheses were: what agrees with them, and what
  // agrees with another place better, shows now.
  void adjust_likelier() {
    for (int round = 0; round < kMaxRounds; ++round) {
      const Component before = out_.component;
      const double likelihood = log_likelihood(graph_, before);
      improve(graph_, out_.component, context_.num_threads);
      if (unmoved(before)) {
        out_.component = before;
        return;
      }
      poses_are_ = StartingPoses::kInferred;
      adjust();
      if (log_likelihood(graph_, out_.component) > likelihood) continue;
      out_.component = before;
      adjust();
      return;
    }
  }

  bool unmoved(const Component& before) const {
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      if (before.has(i) != out_.component.has(i)) return false;
      if (before.has(i) && !graph_.same_pose(i, *before.T_reference_scan[i], *out_.component.T_reference_scan[i])) {
        return false;
      }
    }
    return true;
  }

  void measure() {
    context_.report("verifying", 0, 1);
    const std::vector<Eigen::Isometry3d> T = poses();
    measure_links(T);
    out_.links.clear();
    for (std::size_t k = 0; k < out_.pairs.size(); ++k) {
      const auto [a, b] = out_.pairs[k];
      out_.links.push_back(judge_link(a, b, measurements_of(out_.pairs[k]), hypotheses_.reference()));
    }
    measure_uncertainty(scans_, out_.pairs, out_.component.reference, resolutions_, T, context_.num_threads,
                        out_.uncertainty, out_.links);
    const std::vector<std::size_t> members = out_.component.members();
    std::vector<ScanMeasurements> measured(members.size());
    parallel_for(context_.num_threads, members.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) measured[k] = measure(members[k], T);
    });
    const PairGraph graph = graph_.with(there_);
    cuts_ = weakest_cuts(graph, out_.component, context_.num_threads);
    if (members.size() > 1) cuts_.push_back(measure_cut(graph, out_.component, {out_.component.reference}));
    for (std::size_t k = 0; k < members.size(); ++k) {
      out_.measurements[members[k]] = measured[k];
      weigh_cuts(members[k], *out_.measurements[members[k]]);
    }
  }

  // Those that were measured where they are, but for what no measurement tells, are not measured again.
  void measure_links(const std::vector<Eigen::Isometry3d>& T) {
    std::vector<MeasuredAt> now(overlapping_.size());
    parallel_for(context_.num_threads, overlapping_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto [a, b] = overlapping_[k];
        const Eigen::Isometry3d T_a_b = T[a].inverse() * T[b];
        const auto known = measured_.find(overlapping_[k]);
        const bool is_known =
            known != measured_.end() && rms_displacement(T_a_b.inverse() * known->second.T_a_b, scans_[b].moments) <
                                            kUnmovedInVoxels * resolutions_.fine_m;
        now[k] = is_known ? known->second : MeasuredAt{T_a_b, measure_link(scans_[a], scans_[b], T_a_b)};
      }
    });
    for (std::size_t k = 0; k < overlapping_.size(); ++k) {
      measured_.insert_or_assign(overlapping_[k], std::move(now[k]));
    }
    there_ = hypotheses_.compared_there(measured_there());
  }

  // Fits of pairs that little holds slide away from poses that are right, and then say nothing of them. Poses were
  // adjusted to what lies nearest, so that this agrees at wrong ones, too; not to what scans see through one another.
  std::vector<MeasuredPose> measured_there() const {
    std::vector<MeasuredPose> out;
    for (const auto& pair : overlapping_) {
      const MeasuredAt& at = measured_.at(pair);
      if (at.measurements.free_space.tells()) out.push_back({pair.first, pair.second, at.T_a_b, at.measurements});
    }
    return out;
  }

  const LinkMeasurements& measurements_of(const ScanPairs::value_type& pair) const {
    return measured_.at(pair).measurements;
  }

  ScanMeasurements measure(std::size_t scan, const std::vector<Eigen::Isometry3d>& T) const {
    std::vector<LinkOfScan> links;
    for (const auto& pair : out_.pairs) {
      if (pair.first != scan && pair.second != scan) continue;
      links.push_back({pair.first == scan ? pair.second : pair.first, &measurements_of(pair)});
    }
    ScanMeasurements out = measure_scan(scans_, scan, links, T);
    if (scan < out_.uncertainty.poses.size()) {
      out.sigma_in_voxels =
          sigma_in_voxels(out_.uncertainty.poses[scan], scans_[scan].moments, T[scan], resolutions_.coarse_m);
    }
    return out;
  }

  void weigh_cuts(std::size_t scan, ScanMeasurements& m) const {
    const Cut* weakest = weakest_cut_of(scan, cuts_);
    if (weakest == nullptr) return;
    m.lead = weakest->lead();
    m.support = weakest->support;
    m.num_moved = weakest->moved.size();
    for (std::size_t k = 0; k < out_.pairs.size(); ++k) {
      if (weakest->moves(out_.pairs[k].first) == weakest->moves(out_.pairs[k].second)) continue;
      ++m.num_across;
      m.free_space_across += measurements_of(out_.pairs[k]).free_space;
    }
    if (!weakest->other_motion) return;
    const Eigen::Isometry3d& T = *out_.component.T_reference_scan[scan];
    m.other_distance = rms_displacement(T.inverse() * *weakest->other_motion * T, scans_[scan].moments);
  }

  std::vector<std::size_t> decide_members() {
    const std::vector<std::size_t> members = out_.component.members();
    if (members.size() < 2) return {};
    std::vector<ScanMeasurements> all;
    for (const std::size_t i : members) all.push_back(*out_.measurements[i]);
    const ComponentReference usual = ComponentReference::of(all);
    for (const std::size_t i : members) out_.decisions[i] = decide(*out_.measurements[i], usual, options_.decision);
    return leaving_scans(members, out_.decisions, cuts_, out_.pairs);
  }

  void choose_another_reference() {
    const std::vector<std::size_t> members = out_.component.members();
    std::size_t best = members.front();
    for (const std::size_t i : members) {
      if (out_.decisions[i].probability > out_.decisions[best].probability) best = i;
    }
    change_reference(out_.component, best);
  }

  void choose_best_reference() {
    std::vector<std::vector<std::size_t>> adjacency(scans_.size());
    for (const auto& [a, b] : out_.pairs) {
      adjacency[a].push_back(b);
      adjacency[b].push_back(a);
    }
    const std::size_t best = choose_reference(adjacency);
    if (out_.component.has(best) && adjacency[best].size() > adjacency[out_.component.reference].size()) {
      change_reference(out_.component, best);
    }
  }

  const std::vector<PreparedScan>& scans_;
  const HypothesisSet& hypotheses_;
  const PairGraph& graph_;
  const Resolutions& resolutions_;
  const PipelineOptions& options_;
  const RunContext& context_;
  const StepStore* steps_;
  SettledComponent out_;
  ScanPairs overlapping_;  // of members, those that the adjustment leaves out, too
  StartingPoses poses_are_ = StartingPoses::kInferred;
  std::map<ScanPairs::value_type, MeasuredAt> measured_;
  std::vector<ComparedPair> there_;  // what they show where they are, as far as that tells
  std::vector<Cut> cuts_;
};

}  // namespace

SettledComponent settle(const std::vector<PreparedScan>& scans, const HypothesisSet& hypotheses, const PairGraph& graph,
                        const Resolutions& resolutions, const PipelineOptions& options, const RunContext& context,
                        Component component, const StepStore* steps) {
  return Settling(scans, hypotheses, graph, resolutions, options, context, std::move(component), steps).run();
}

}  // namespace tcm_icp
