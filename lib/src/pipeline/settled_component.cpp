#include "pipeline/settled_component.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>

#include "adjustment/adjustment.hpp"
#include "adjustment/uncertainty.hpp"
#include "decision/link_decision.hpp"
#include "inference/configuration.hpp"
#include "inference/cuts.hpp"
#include "links/measure_link.hpp"
#include "links/verification_at.hpp"
#include "merging/merged_cloud.hpp"
#include "pipeline/scan_set.hpp"
#include "pipeline/solve_steps.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

// Of a scan: those it overlaps most with say what there is to say, and each costs time.
constexpr std::size_t kMaxNeighbors = 6;
constexpr std::size_t kUnionPoints = 1000;
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
    out_.pairs = hypotheses_.without_unlikely(overlapping_, T);
    out_.adjustment = adjust_once(steps_, scans_, out_.pairs, out_.component.reference, resolutions_,
                                  options_.adjustment, options_.lp, context_, T, poses_are_);
    poses_are_ = StartingPoses::kAdjusted;
    for (const std::size_t i : out_.component.members()) out_.component.T_reference_scan[i] = T[i];
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
      for (std::size_t k = begin; k < end; ++k) measured[k] = measure_scan(members[k], T);
    });
    const PairGraph graph = graph_.with(hypotheses_.compared_there(measured_there()));
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

  // The scan's points against the union of those it overlaps most with.
  ScanMeasurements measure_scan(std::size_t scan, const std::vector<Eigen::Isometry3d>& T) const {
    ScanMeasurements out;
    std::vector<std::pair<double, std::size_t>> neighbors;
    for (std::size_t k = 0; k < out_.pairs.size(); ++k) {
      const auto [a, b] = out_.pairs[k];
      if (a != scan && b != scan) continue;
      const LinkMeasurements& m = measurements_of(out_.pairs[k]);
      neighbors.emplace_back(-m.evidence.overlap, a == scan ? b : a);
      out.free_space += m.free_space;
    }
    out.sigma_in_voxels = sigma_in_voxels(scan, T[scan]);
    if (neighbors.empty()) return out;
    std::sort(neighbors.begin(), neighbors.end());
    const double voxel_m = scans_[scan].pyramid.level(0).voxel_size_m;
    MergedCloud cloud(voxel_m);
    for (std::size_t k = 0; k < std::min(kMaxNeighbors, neighbors.size()); ++k) {
      const std::size_t other = neighbors[k].second;
      cloud.add(scans_[other].pyramid.level(0).cloud, T[other]);
    }
    out.evidence = verify_alignment(even_sample(scans_[scan].held_out_sample, kUnionPoints), cloud.level(), T[scan],
                                    verification_at(voxel_m));
    return out;
  }

  // Rms over the scan's points, from the covariance of its pose.
  std::optional<double> sigma_in_voxels(std::size_t scan, const Eigen::Isometry3d& T) const {
    if (scan >= out_.uncertainty.poses.size()) return std::nullopt;
    const PoseUncertainty& u = out_.uncertainty.poses[scan];
    if (!u.determined) return std::nullopt;
    const PointMoments& points = scans_[scan].moments;
    const Eigen::Vector3d from_centre = T * points.mean - u.centre;
    const Eigen::Matrix3d spread =
        T.linear() * points.covariance * T.linear().transpose() + from_centre * from_centre.transpose();
    const Eigen::Matrix3d rotation = u.covariance.topLeftCorner<3, 3>();
    const double variance_m2 = (rotation * (spread.trace() * Eigen::Matrix3d::Identity() - spread)).trace() +
                               u.covariance.bottomRightCorner<3, 3>().trace();
    return std::sqrt(std::max(0.0, variance_m2)) / resolutions_.coarse_m;
  }

  // The cut with the least lead of those that move this scan.
  const Cut* weakest_cut_of(std::size_t scan) const {
    const Cut* weakest = nullptr;
    for (const Cut& cut : cuts_) {
      if (!cut.moves(scan)) continue;
      if (weakest == nullptr || cut.lead() < weakest->lead()) weakest = &cut;
    }
    return weakest;
  }

  void weigh_cuts(std::size_t scan, ScanMeasurements& m) const {
    const Cut* weakest = weakest_cut_of(scan);
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

  // Who leaves: nobody, where all pass. What a scan that does not pass is linked to is judged again without it, whether
  // it leaves now or waits for a worse one itself; what is not leaves together with it.
  std::vector<std::size_t> decide_members() {
    const std::vector<std::size_t> members = out_.component.members();
    if (members.size() < 2) return {};
    std::vector<ScanMeasurements> all;
    for (const std::size_t i : members) all.push_back(*out_.measurements[i]);
    const ComponentReference usual = ComponentReference::of(all);
    std::vector<std::size_t> worst_first;
    for (const std::size_t i : members) {
      out_.decisions[i] = decide(*out_.measurements[i], usual, options_.decision);
      if (!out_.decisions[i].accepted()) worst_first.push_back(i);
    }
    if (worst_first.empty()) return {};
    if (const Cut* contradicted = most_contradicted()) return smaller_side(*contradicted, members);
    std::stable_sort(worst_first.begin(), worst_first.end(), [&](std::size_t x, std::size_t y) {
      return out_.decisions[x].probability < out_.decisions[y].probability;
    });
    std::vector<std::size_t> leaving;
    std::vector<bool> is_touched(scans_.size(), false);  // does not pass, or is linked to what does not
    for (const std::size_t i : worst_first) {
      const std::vector<std::size_t> part = leaving_with(i, members);
      const bool waits = std::any_of(part.begin(), part.end(), [&](std::size_t j) { return is_touched[j]; }) ||
                         (!leaving.empty() && 2 * part.size() > members.size() - leaving.size());
      if (!waits) leaving.insert(leaving.end(), part.begin(), part.end());
      std::vector<bool> fails(scans_.size(), false);
      for (const std::size_t j : part) is_touched[j] = fails[j] = true;
      for (const auto& [a, b] : out_.pairs) {
        if (fails[a] || fails[b]) is_touched[a] = is_touched[b] = true;
      }
    }
    return leaving;
  }

  // What the pairs across speak against, as poses are adjusted: hypotheses hung it there that the others do not bear
  // out. Wherever it belongs, it spoils what is measured of its neighbours here.
  const Cut* most_contradicted() const {
    const Cut* worst = nullptr;
    for (const Cut& cut : cuts_) {
      const bool fails =
          std::any_of(cut.moved.begin(), cut.moved.end(), [&](std::size_t i) { return !out_.decisions[i].accepted(); });
      if (cut.support >= 0 || !fails) continue;
      const bool is_worse = worst == nullptr || cut.support < worst->support ||
                            (cut.support == worst->support && cut.moved.size() > worst->moved.size());
      if (is_worse) worst = &cut;
    }
    return worst;
  }

  // What may lie elsewhere leaves as a whole.
  std::vector<std::size_t> leaving_with(std::size_t scan, const std::vector<std::size_t>& members) const {
    const Cut* cut = weakest_cut_of(scan);
    if (out_.decisions[scan].reason != Reason::kAmbiguous || cut == nullptr) return {scan};
    return smaller_side(*cut, members);
  }

  // Of two parts that may lie elsewhere to one another, the larger stays.
  static std::vector<std::size_t> smaller_side(const Cut& cut, const std::vector<std::size_t>& members) {
    if (2 * cut.moved.size() <= members.size()) return cut.moved;
    std::vector<std::size_t> others;
    std::set_difference(members.begin(), members.end(), cut.moved.begin(), cut.moved.end(), std::back_inserter(others));
    return others;
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
  std::vector<Cut> cuts_;
};

}  // namespace

SettledComponent settle(const std::vector<PreparedScan>& scans, const HypothesisSet& hypotheses, const PairGraph& graph,
                        const Resolutions& resolutions, const PipelineOptions& options, const RunContext& context,
                        Component component, const StepStore* steps) {
  return Settling(scans, hypotheses, graph, resolutions, options, context, std::move(component), steps).run();
}

}  // namespace tcm_icp
