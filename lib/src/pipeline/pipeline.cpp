#include "tcm_icp/pipeline/pipeline.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "adjusted_set.hpp"
#include "group_joining.hpp"
#include "link_score.hpp"
#include "link_verification.hpp"
#include "merging.hpp"
#include "name_order.hpp"
#include "pair_search.hpp"
#include "scan_set.hpp"
#include "scan_sight.hpp"
#include "stage_clock.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "uncertainty.hpp"

namespace tcm_icp {
namespace {

void move(Viewpoint& viewpoint, const Eigen::Vector3d& by) {
  viewpoint.place += by;
  for (auto& p : viewpoint.alternatives) p += by;
}

class Run {
 public:
  Run(const PipelineOptions& options, const RunContext& context)
      : options_(options), context_(context), clock_(result_.stages) {}

  PipelineResult operator()(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses) {
    if (!options_.reference.empty()) result_.reference = find_scan(paths, options_.reference);
    clock_.begin("read and sample");
    read(paths);
    clock_.begin("prepare");
    prepare(initial_poses);
    clock_.begin("link");
    find_links();
    merge_and_adjust();
    clock_.end();
    report_poses();
    report_hypotheses();
    return std::move(result_);
  }

 private:
  bool paper() const { return options_.profile == Profile::kPaper; }

  void read(const std::vector<std::filesystem::path>& paths) {
    sampled_ = read_scans(paths, options_, context_, paper() ? ScanDetail::kNormals : ScanDetail::kLinePieces);
    for (const auto& s : sampled_) {
      result_.scans.push_back(summarize(s));
      files_.push_back(s.scan.file);
    }
  }

  void prepare(const InitialPoses& initial_poses) {
    resolutions_ = choose_resolutions(sampled_, options_.sampling, context_.num_threads);
    result_.coarse_voxel_m = resolutions_.coarse_m;
    result_.fine_voxel_m = resolutions_.fine_m;
    T_init_ = initial_local_poses(initial_poses, sampled_, paper());
    if (!paper()) result_.viewpoints = find_viewpoints(sampled_, context_);
    scans_ = prepare_scans(sampled_, resolutions_, options_.placement, context_);
    if (!paper()) make_sights(result_.viewpoints, context_, scans_);
    for (std::size_t i = 0; i < result_.viewpoints.size(); ++i) {
      if (result_.viewpoints[i]) move(*result_.viewpoints[i], sampled_[i].scan.origin);
    }
  }

  // Which scans lie near which: by links found without any guess, and by the guesses where all scans have one. Links
  // come first in merging: a guess alone does not tell one bay of a hall from the next.
  void find_links() {
    const bool all_guessed = std::all_of(T_init_.begin(), T_init_.end(), [](const auto& T) { return bool(T); });
    graph_ = PoseGraph(scans_.size());
    if (!paper()) {
      pair_search_.emplace(scans_, files_, options_, context_);
      pair_search_->run(graph_);
      weigh_links();
    }
    result_.graph = all_guessed ? compare_scans(scans_, values_of(T_init_), options_, context_)
                                : graph_.correspondence_graph(std::vector<bool>(scans_.size(), true));
    if (options_.reference.empty()) result_.reference = result_.graph.reference;
    result_.graph.reference = result_.reference;
  }

  void weigh_links() {
    std::vector<PointMoments> moments;
    for (const auto& scan : scans_) moments.push_back(scan.moments);
    graph_.weigh_by_loops(moments, kSameLinkPose * resolutions_.coarse_m);
  }

  // The reference's component first; then what is left, as long as some of it holds together.
  void merge_and_adjust() {
    const std::size_t n = scans_.size();
    result_.evidence.assign(n, std::nullopt);
    std::vector<bool> left(n, true);
    std::size_t reference = result_.reference;
    while (true) {
      components_.push_back(build_component(reference, left));
      const AdjustedSet& component = components_.back();
      for (std::size_t i = 0; i < n; ++i) {
        if (component.placed[i]) left[i] = false;
      }
      if (paper()) break;
      const CorrespondenceGraph rest = graph_.correspondence_graph(left);
      if (rest.degree(rest.reference) == 0) break;
      reference = rest.reference;
    }
    if (pair_search_) join();
    choose_main_group();
  }

  MergeInput merge_input() const { return {scans_, files_, T_init_, graph_, options_, context_}; }

  // Groups that no link joined, by all that each of them saw; as long as that leaves more scans in one frame.
  void join() {
    while (components_.size() > 1 || components_.front().num_placed() < scans_.size()) {
      sort_components();
      clock_.begin("join groups");
      std::optional<GroupJoin> found = join_groups(merge_input(), resolutions_, components_, result_.merges);
      if (!found) break;
      complete(found->set);
      std::size_t largest = 0;
      for (const std::size_t part : found->parts) largest = std::max(largest, components_[part].num_placed());
      if (found->set.num_placed() <= largest) {
        context_.debug("not joined: only " + std::to_string(found->set.num_placed()) + " scans hold together");
        for (std::size_t i = 0; i < scans_.size(); ++i) {
          if (!found->set.placed[i]) context_.debug(files_[i] + ": " + found->set.reasons[i]);
        }
        break;
      }
      components_[found->parts.front()] = std::move(found->set);
      std::vector<AdjustedSet> kept;
      for (std::size_t k = 0; k < components_.size(); ++k) {
        const bool joined = std::find(found->parts.begin() + 1, found->parts.end(), k) != found->parts.end();
        if (!joined) kept.push_back(std::move(components_[k]));
      }
      components_ = std::move(kept);
    }
  }

  // The largest group is what the user wants; a scan that links promised much of may hold little.
  void sort_components() {
    if (!options_.reference.empty()) return;
    std::stable_sort(components_.begin(), components_.end(),
                     [](const AdjustedSet& a, const AdjustedSet& b) { return a.num_placed() > b.num_placed(); });
  }

  void choose_main_group() {
    sort_components();
    result_.reference = result_.graph.reference = components_.front().reference;
    result_.adjustment = components_.front().adjustment;
    result_.uncertainty = components_.front().uncertainty;
    for (const auto& set : components_) {
      result_.links.insert(result_.links.end(), set.links.begin(), set.links.end());
    }
  }

  AdjustedSet build_component(std::size_t reference, const std::vector<bool>& wanted) {
    clock_.begin("merge");
    Merging merging(merge_input(), reference, wanted);
    const std::size_t first = result_.merges.size();
    merging.run(result_.merges);
    // Scans that found no place may have links that were not tried yet.
    while (pair_search_ && pair_search_->extend(graph_, merging.unplaced())) {
      weigh_links();
      merging.run(result_.merges);
    }
    AdjustedSet set = set_of_one(reference, scans_.size());
    set.placed = merging.placed();
    set.T_reference_scan = merging.T_reference_scan();
    for (const auto& [pair, link] : graph_.links()) {
      if (link.trust > 0 || link.hypotheses.empty() || link.hypotheses.front().log_odds < kClearLogOdds) continue;
      for (const std::size_t i : {pair.first, pair.second}) {
        set.reasons[i] =
            "its links and those of others contradict one another around loops: the place may repeat itself";
      }
    }
    for (std::size_t k = first; k < result_.merges.size(); ++k) {
      set.evidence[result_.merges[k].scan] = result_.merges[k].evidence;
      set.reasons[result_.merges[k].scan] = result_.merges[k].reason;
    }
    complete(set);
    return set;
  }

  // Poses adjusted and judged, links between members measured.
  void complete(AdjustedSet& set) {
    if (paper()) {
      set.pairs = overlapping_pairs(scans_, set.T_reference_scan, set.placed, kMinLinkOverlap, context_.num_threads);
      set.free_space_of_pairs.assign(set.pairs.size(), {});  // without viewpoints
    } else {
      clock_.begin("adjust and verify");
      adjust_and_verify(scans_, graph_, resolutions_, options_, context_, set);
    }
    set.links = verify_links(scans_, set.pairs, set.free_space_of_pairs, set.T_reference_scan, context_.num_threads);
    if (!paper()) {
      measure_uncertainty(scans_, set.pairs, set.reference, resolutions_, set.T_reference_scan, context_.num_threads,
                          set.uncertainty, set.links);
    }
  }

  void report_poses() {
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      const auto mine =
          std::find_if(components_.begin(), components_.end(), [&](const AdjustedSet& set) { return set.placed[i]; });
      const bool alone = mine == components_.end();
      // What the reference's component says of a scan that nobody took is what counts.
      const AdjustedSet& set = alone ? components_.front() : *mine;
      ScanPose pose;
      pose.file = files_[i];
      pose.reason = set.reasons[i];
      result_.evidence[i] = set.evidence[i];
      result_.free_space.push_back(set.free_space[i]);
      // Raw coordinates to the reference's raw coordinates: both local origins are put back.
      const Eigen::Isometry3d T = Eigen::Translation3d(sampled_[set.reference].scan.origin) * set.T_reference_scan[i] *
                                  Eigen::Translation3d(-sampled_[i].scan.origin);
      if (i == result_.reference) {
        pose.status = ScanStatus::kReference;
        pose.verdict = "accepted";
        pose.reason = "the reference";
      } else if (alone) {
        pose.verdict = "rejected";
      } else if (mine == components_.begin()) {
        pose.status = ScanStatus::kRegistered;
        pose.verdict = paper() ? "doubtful" : "accepted";
        pose.T_reference_scan = T;
      } else {
        pose.verdict = "rejected";
        pose.pose_in_component = T;
        pose.reason = i == set.reference ? "the reference of a group that does not hold together with the others"
                                         : "belongs to the group of " + files_[set.reference] + ": " + pose.reason;
      }
      result_.poses.push_back(std::move(pose));
    }
    number_components();
  }

  // The reference's group is 0, other groups and single scans follow in the order of their names.
  void number_components() {
    std::vector<int> number(components_.size(), -1);
    number[0] = 0;
    int next = 1;
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      std::size_t c = 0;
      while (c < components_.size() && !components_[c].placed[i]) ++c;
      if (c == components_.size() || components_[c].num_placed() == 1) {
        if (i == result_.reference) continue;
        result_.poses[i].component = next++;
        result_.poses[i].pose_in_component.reset();
        continue;
      }
      if (number[c] < 0) number[c] = next++;
      result_.poses[i].component = number[c];
    }
  }

  // Loops close over the final poses: what they contradict is named.
  void report_hypotheses() {
    const double same_m = kSameLinkPose * resolutions_.coarse_m;
    for (const auto& [pair, link] : graph_.links()) {
      const auto [a, b] = pair;
      const auto both = std::find_if(components_.begin(), components_.end(),
                                     [a = a, b = b](const AdjustedSet& set) { return set.placed[a] && set.placed[b]; });
      for (const auto& h : link.hypotheses) {
        LinkHypothesisRecord record{a, b, {}, h.candidate, h.evidence, h.free_space, h.log_odds, link.trust, "open"};
        record.T_a_b =
            Eigen::Translation3d(sampled_[a].scan.origin) * h.T_a_b * Eigen::Translation3d(-sampled_[b].scan.origin);
        if (both != components_.end()) {
          const Eigen::Isometry3d T_a_b = both->T_reference_scan[a].inverse() * both->T_reference_scan[b];
          const double apart_m = rms_displacement(T_a_b.inverse() * h.T_a_b, scans_[b].moments);
          record.fate = apart_m < same_m ? "confirmed" : "contradicted";
        }
        result_.hypotheses.push_back(record);
      }
    }
  }

  const PipelineOptions& options_;
  const RunContext& context_;
  PipelineResult result_;
  StageClock clock_;
  std::vector<SampledScan> sampled_;
  std::vector<std::string> files_;
  Resolutions resolutions_;
  std::vector<PreparedScan> scans_;
  InitialPoses T_init_;  // common frame of the initial poses <- local frame
  PoseGraph graph_{0};
  std::optional<PairSearch> pair_search_;
  std::vector<AdjustedSet> components_;
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
  // Who asks for the order of the list gets it.
  if (options_.merge_order == MergeOrder::kFile) return Run(options_, context)(paths, initial_poses);
  const std::vector<std::size_t> order = order_by_name(paths);
  PipelineResult result = Run(options_, context)(in_order(paths, order), in_order(initial_poses, order));
  restore_order(order, result);
  return result;
}

}  // namespace tcm_icp
