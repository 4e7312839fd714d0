// The default: compared without a guess, inferred, merged in the order of the TCM, adjusted, decided.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>

#include "core/acceptance.hpp"
#include "core/figure_text.hpp"
#include "inference/configuration.hpp"
#include "inference/cuts.hpp"
#include "inference/implied_poses.hpp"
#include "inference/margins.hpp"
#include "links/pair_search.hpp"
#include "pipeline/kept_set.hpp"
#include "pipeline/pipeline_input.hpp"
#include "pipeline/scan_set.hpp"
#include "pipeline/settled_component.hpp"
#include "pipeline/solve_steps.hpp"
#include "pipeline/survey_frame.hpp"
#include "scans/scan_sight.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// The likeliest poses by the hypotheses there are.
struct Inferred {
  PairGraph graph;
  std::vector<Component> components;
  std::vector<std::vector<Cut>> cuts;  // the weakest of each component
};

constexpr double kMostLead = 12;  // what is less likely by so much is asked by nobody before poses are decided on
constexpr int kLeastStarts = 2;   // of large sets, where there are other hypotheses
constexpr int kMaxLearnt = 4;     // rounds: what the set's constant is, and which poses are likeliest with it
constexpr int kMaxImplied = 3;    // rounds: what they show may move scans, which implies other poses

class RobustPipeline {
 public:
  RobustPipeline(const PipelineInput& input, PipelineResult& result)
      : in_(input), result_(result), inference_(input.options.inference) {
    if (leaves_out(LeftOut::kTwins)) inference_.log_twins = std::numeric_limits<double>::max();
    if (leaves_out(LeftOut::kSetConstant)) inference_.set_spread = 0;
  }

  void run() {
    prepare();
    compare_pairs();
    build_components();
    choose_main_component();
    if (!in_.survey.empty()) placement_ = fit_to_survey(in_, scans_, resolutions_, settled_, result_);
    report_poses();
    report_hypotheses();
  }

 private:
  std::size_t size() const { return in_.sampled.size(); }
  bool leaves_out(LeftOut stage) const { return in_.options.without == stage; }

  void prepare() {
    in_.clock.begin("prepare");
    resolutions_ = choose_resolutions(in_.sampled, in_.options.sampling, in_.context.num_threads);
    if (in_.steps != nullptr) keep_lengths();
    T_init_ = initial_local_poses(in_.initial_poses, in_.sampled, false);
    result_.viewpoints = find_viewpoints(in_.sampled, in_.context, in_.steps);
    result_.coarse_voxel_m = resolutions_.coarse_m;
    result_.fine_voxel_m = resolutions_.fine_m;
    scans_ = prepare_scans(in_.sampled, resolutions_, in_.options.samples, in_.context);
    if (!leaves_out(LeftOut::kFreeSpace)) make_sights(result_.viewpoints, in_.context, scans_);
    for (std::size_t i = 0; i < size(); ++i) {
      if (!result_.viewpoints[i]) continue;
      result_.viewpoints[i]->place += in_.sampled[i].scan.origin;
      for (auto& p : result_.viewpoints[i]->alternatives) p += in_.sampled[i].scan.origin;
    }
  }

  // Those of a smaller set that scans were added to.
  void keep_lengths() {
    const KeptSet kept = keep_resolutions(*in_.steps, in_.sampled, in_.options.sampling, resolutions_);
    kept_.store = in_.steps;
    if (kept.base.empty()) return;
    kept_.base = prepared_digests(kept.base, kept.resolutions, in_.options.samples, in_.context.seed);
    std::ostringstream said;
    said << "the resolutions are kept from the " << kept.base.size()
         << " scans that were registered before in the work folder: " << kept.resolutions.coarse_m << " m and "
         << kept.resolutions.fine_m << " m, where all scans would give " << resolutions_.coarse_m << " m and "
         << resolutions_.fine_m << " m";
    resolutions_ = kept.resolutions;
    in_.context.info(said.str());
    result_.warnings.push_back(said.str());
  }

  // Poses that pairs may have; more are looked for as long as inference leaves a scan without a clear place.
  void compare_pairs() {
    in_.clock.begin("link");
    std::vector<PointMoments> moments;
    std::vector<double> noise_m;
    for (std::size_t i = 0; i < size(); ++i) {
      moments.push_back(scans_[i].moments);
      noise_m.push_back(in_.sampled[i].scan.noise_m);
    }
    hypotheses_.emplace(resolutions_.coarse_m, median(noise_m), std::move(moments),
                        survey_evidence(in_, scans_, resolutions_.coarse_m));
    const LinkSearchOptions options{in_.options.formulation, in_.options.lp, in_.options.level,
                                    !leaves_out(LeftOut::kFeatures), !leaves_out(LeftOut::kSlides)};
    PairSearch search(scans_, options, in_.context, kept_);
    std::vector<bool> wanted(size(), true);
    std::vector<std::size_t> groups(size());
    std::iota(groups.begin(), groups.end(), std::size_t{0});
    while (search.extend(wanted, groups, *hypotheses_)) {
      Inferred now = infer_with_implied(search);
      join_groups(search, now);
      groups = groups_of(now);
      wanted = without_clear_place(now);
      in_.context.debug(std::to_string(std::count(wanted.begin(), wanted.end(), true)) + " of " +
                        std::to_string(size()) + " scans have no clear place; " +
                        std::to_string(hypotheses_->pairs().size()) + " pairs were compared");
      if (std::count(wanted.begin(), wanted.end(), true) == 0) break;
    }
    search.try_guesses(T_init_, *hypotheses_);  // they place what the search did not
  }

  // What the likeliest poses imply of other pairs is asked, too.
  Inferred infer_with_implied(PairSearch& search) {
    const int max_implied = leaves_out(LeftOut::kImpliedPoses) ? 0 : kMaxImplied;
    Inferred now = infer(kLeastStarts);
    for (int round = 0; round < max_implied && search.try_implied(implied(now, search), *hypotheses_); ++round) {
      now = infer(1);
    }
    return now;
  }

  // By what their margins have in common, as long as that leaves fewer of them.
  void join_groups(PairSearch& search, Inferred& now) {
    const std::size_t most = search.most_between();
    if (most == 0) return;
    for (std::vector<std::size_t> groups = groups_of(now);;) {
      if (!search.try_between(margins_of_groups(now.graph, now.components, groups, most), groups, *hypotheses_)) return;
      now = infer_with_implied(search);
      std::vector<std::size_t> joined = groups_of(now);
      if (num_groups(joined) >= num_groups(groups)) return;
      groups = std::move(joined);
    }
  }

  std::vector<std::size_t> groups_of(const Inferred& now) const {
    return clear_groups(now.components, now.cuts, kLeadToRest, size());
  }
  static std::size_t num_groups(const std::vector<std::size_t>& groups) {
    return *std::max_element(groups.begin(), groups.end()) + 1;
  }

  Inferred infer(int least_starts) {
    for (int round = 1;; ++round, least_starts = 1) {
      PairGraph graph = hypotheses_->graph(std::vector<bool>(size(), true), inference_);
      std::vector<Component> components = components_of(graph, least_starts);
      std::vector<std::vector<Cut>> cuts;
      for (const Component& component : components) {
        cuts.push_back(weakest_cuts(graph, component, in_.context.num_threads, kMostLead));
      }
      if (round == kMaxLearnt || !hypotheses_->learn_constants(components, cuts, inference_.set_spread)) {
        return {std::move(graph), std::move(components), std::move(cuts)};
      }
      hypotheses_->score();
    }
  }

  // Beginning with the likeliest of last time: what hypotheses since then change is little.
  std::vector<Component> components_of(const PairGraph& graph, int least_starts) {
    known_ = likeliest_components(graph, known_, least_starts, in_.context.num_threads);
    return known_;
  }

  static std::vector<ImpliedPose> implied(const Inferred& now, const PairSearch& search) {
    std::vector<ImpliedPose> out;
    const auto may_overlap = [&](std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) {
      return search.may_overlap(a, b, T_a_b);
    };
    for (std::size_t c = 0; c < now.components.size(); ++c) {
      const auto poses = implied_poses(now.graph, now.components[c], now.cuts[c], kLeadToRest, may_overlap);
      out.insert(out.end(), poses.begin(), poses.end());
    }
    return out;
  }

  std::vector<bool> without_clear_place(const Inferred& now) const {
    std::vector<bool> out(size(), true);
    if (now.components.empty()) return out;
    const Component& largest = now.components.front();
    for (const std::size_t i : largest.members()) out[i] = false;
    for (const Cut& cut : now.cuts.front()) {
      if (cut.lead() >= kLeadToRest) continue;
      for (const std::size_t i : frontier(now.graph, largest, cut)) out[i] = true;
    }
    return out;
  }

  // The likeliest component first; then what is left, as long as some of it holds together. Scans that a component has
  // set aside are open again to those after it, which are therefore inferred anew.
  void build_components() {
    result_.measurements.resize(size());
    result_.decisions.resize(size());
    std::vector<bool> left(size(), true);
    for (bool is_any_settled = true; is_any_settled;) {
      is_any_settled = false;
      const PairGraph graph = hypotheses_->graph(left, inference_);
      for (Component& component : components_of(graph, kLeastStarts)) {
        const std::size_t num_inferred = component.size();
        SettledComponent settled = merge_and_settle(graph, std::move(component));
        const std::size_t num_kept = settled.component.size();
        keep_decisions(settled);
        if (num_kept < 2) continue;
        for (const std::size_t i : settled.component.members()) left[i] = false;
        settled_.push_back(std::move(settled));
        is_any_settled = true;
        if (num_kept < num_inferred) break;
      }
      known_.clear();  // with the scans that are settled
    }
  }

  SettledComponent merge_and_settle(const PairGraph& graph, Component component) {
    if (!in_.options.reference.empty() && component.has(result_.reference)) {
      change_reference(component, result_.reference);
    }
    in_.clock.begin("merge");
    const auto records = merge_once(in_.steps, scans_, graph, in_.options.merging(), in_.context, component);
    for (const MergeRecord& r : records) in_.context.debug(in_.files[r.scan] + " merged: " + r.reason);
    result_.merges.insert(result_.merges.end(), records.begin(), records.end());
    in_.clock.begin("adjust and verify");
    return settle(scans_, *hypotheses_, graph, resolutions_, in_.options, in_.context, std::move(component), in_.steps);
  }

  // A scan's last decision is that of the component it is in; of one that is in none, the first.
  void keep_decisions(const SettledComponent& settled) {
    const bool holds = settled.component.size() >= 2;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto& measured = settled.measurements[i];
      const Decision& decision = settled.decisions[i];
      if (measured && !decision.accepted()) {
        std::ostringstream said;
        said << in_.files[i] << " set aside: " << decision.text << "; probability " << decision.probability << ", lead "
             << measured->lead;
        in_.context.debug(said.str());
      }
      const bool is_member = holds && settled.component.has(i);
      if (!is_member && (!measured || result_.measurements[i])) continue;
      result_.measurements[i] = measured;
      result_.decisions[i] = decision;
    }
  }

  void choose_main_component() {
    std::stable_sort(settled_.begin(), settled_.end(), [&](const SettledComponent& a, const SettledComponent& b) {
      const bool named = !in_.options.reference.empty();
      const bool a_named = named && a.component.has(result_.reference),
                 b_named = named && b.component.has(result_.reference);
      return a_named != b_named ? a_named : a.component.size() > b.component.size();
    });
    const bool misses_named =
        !in_.options.reference.empty() && (settled_.empty() || !settled_.front().component.has(result_.reference));
    if (settled_.empty() || misses_named) {
      SettledComponent alone;
      alone.component = component_of_one(in_.options.reference.empty() ? middle_scan() : result_.reference, size());
      settled_.insert(settled_.begin(), std::move(alone));
    }
    const SettledComponent& main = settled_.front();
    result_.reference = main.component.reference;
    result_.adjustment = main.adjustment;
    result_.uncertainty = main.uncertainty;
    for (const auto& s : settled_) result_.links.insert(result_.links.end(), s.links.begin(), s.links.end());
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd measure = Eigen::MatrixXd::Ones(n, n);
    for (const auto& [pair, found] : hypotheses_->pairs()) {
      if (found.empty() || found.front().log_odds <= 0) continue;
      const auto a = static_cast<Eigen::Index>(pair.first), b = static_cast<Eigen::Index>(pair.second);
      measure(a, b) = measure(b, a) = 1 / (1 + std::exp(found.front().log_odds));
    }
    result_.graph = build_correspondence_graph(measure, 1.0);
    result_.graph.reference = result_.reference;
  }

  std::size_t middle_scan() const { return size() / 2; }

  void report_poses() {
    result_.evidence.assign(size(), std::nullopt);
    result_.free_space.assign(size(), {});
    int next_component = 1;
    std::vector<int> number(settled_.size(), -1);
    number[0] = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      std::size_t c = 0;
      while (c < settled_.size() && !settled_[c].component.has(i)) ++c;
      const auto& measured = result_.measurements[i];
      if (measured) {
        result_.evidence[i] = measured->evidence;
        result_.free_space[i] = measured->free_space;
      }
      Decision& decision = result_.decisions[i];
      ScanPose pose;
      pose.file = in_.files[i];
      pose.reason = decision.reason == Reason::kNotDecided ? std::string(to_string(Reason::kNoLink)) : decision.text;
      if (c == settled_.size()) {
        if (decision.accepted()) pose.reason = "the scans it agrees with are not registered";
        if (decision.accepted() || decision.reason == Reason::kNotDecided) decision.reason = Reason::kNoLink;
        pose.verdict = Verdict::kRejected;
        pose.component = next_component++;
        take_survey_pose(i, pose);
        result_.poses.push_back(std::move(pose));
        continue;
      }
      const Component& component = settled_[c].component;
      const Eigen::Isometry3d T = for_raw_coordinates(*component.T_reference_scan[i],
                                                      in_.sampled[component.reference].scan, in_.sampled[i].scan);
      if (number[c] < 0) number[c] = next_component++;
      pose.component = number[c];
      if (i == result_.reference) {
        pose.status = ScanStatus::kReference;
        pose.verdict = Verdict::kAccepted;
        pose.reason = "the reference";
        decision.reason = Reason::kReference;
        result_.evidence[i] = std::nullopt;
      } else if (c == 0) {
        pose.status = ScanStatus::kRegistered;
        pose.verdict = Verdict::kAccepted;
        pose.T_reference_scan = T;
      } else {
        pose.verdict = Verdict::kRejected;
        pose.pose_in_component = T;
        pose.reason = i == component.reference
                          ? "the reference of a group that does not hold together with the others"
                          : "belongs to the group of " + in_.files[component.reference] + ": " + pose.reason;
      }
      take_survey_pose(i, pose);
      result_.poses.push_back(std::move(pose));
    }
  }

  // Scans that no link ties to the reference may be in the survey frame by themselves.
  void take_survey_pose(std::size_t scan, ScanPose& pose) const {
    if (placement_.T_survey_scan.empty() || !placement_.T_survey_scan[scan]) return;
    pose.T_reference_scan = *placement_.T_survey_scan[scan];
    if (pose.status != ScanStatus::kUnregistered) return;
    pose.status = ScanStatus::kRegistered;
    const auto& sigma = placement_.sigma_in_voxels[scan];
    const bool is_sure = sigma.has_value() && *sigma <= kSureInSurvey;
    pose.verdict = is_sure && placement_.is_confirmed[scan] ? Verdict::kAccepted : Verdict::kDoubtful;
    pose.pose_in_component.reset();
    const std::string how_loosely =
        is_sure || !sigma ? "" : " that leave it loose by " + figure(*sigma) + " coarse voxels";
    pose.reason = "in the survey frame by " + result_.survey.defined_by + " of its own alone" + how_loosely + " (" +
                  pose.reason + ")";
  }

  // What the final poses contradict is named.
  void report_hypotheses() {
    result_.set_log_odds = hypotheses_->reference().constant;
    result_.later_log_odds = hypotheses_->reference().later_constant;
    result_.later_factor = hypotheses_->reference().later_slope;
    for (const auto& [pair, found] : hypotheses_->pairs()) {
      const auto [a, b] = pair;
      const auto both = std::find_if(settled_.begin(), settled_.end(), [a = a, b = b](const SettledComponent& s) {
        return s.component.has(a) && s.component.has(b);
      });
      for (const auto& h : found) {
        LinkHypothesisRecord record;
        record.a = a;
        record.b = b;
        record.T_a_b = for_raw_coordinates(h.T_a_b, in_.sampled[a].scan, in_.sampled[b].scan);
        record.candidate = h.candidate;
        record.candidate.T_target_source =
            for_raw_coordinates(h.candidate.T_target_source, in_.sampled[a].scan, in_.sampled[b].scan);
        record.evidence = h.measurements.evidence;
        record.free_space = h.measurements.free_space;
        record.is_later = h.is_later();
        record.log_odds = h.log_odds;
        record.by_survey = h.by_survey;
        record.features = features_of(h, hypotheses_->reference());
        if (both != settled_.end()) {
          const auto& T = both->component.T_reference_scan;
          const Eigen::Isometry3d T_a_b = T[a]->inverse() * *T[b];
          const double apart_m = rms_displacement(T_a_b.inverse() * h.T_a_b, scans_[b].moments);
          record.status =
              apart_m < hypotheses_->same_m() ? HypothesisStatus::kConfirmed : HypothesisStatus::kContradicted;
        }
        result_.hypotheses.push_back(record);
      }
    }
  }

  const PipelineInput& in_;
  PipelineResult& result_;
  InferenceOptions inference_;  // with what is left out
  Resolutions resolutions_;
  KeptSearches kept_;
  InitialPoses T_init_;  // common frame of the initial poses <- local frame
  std::vector<PreparedScan> scans_;
  std::optional<HypothesisSet> hypotheses_;
  std::vector<Component> known_;
  std::vector<SettledComponent> settled_;
  SurveyPlacement placement_;
};

}  // namespace

void run_robust_pipeline(const PipelineInput& input, PipelineResult& result) { RobustPipeline(input, result).run(); }

}  // namespace tcm_icp
