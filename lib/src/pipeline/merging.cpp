#include "merging.hpp"

#include <algorithm>
#include <cmath>

#include "placement.hpp"
#include "scan_sight.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

/// The measures need two points at the least, and so does a fit.
constexpr std::size_t kMinPoints = 2;
/// Scans whose links say so much go first: what is merged wrongly misleads all that follow.
constexpr double kStrongLogOdds = 6;

bool uses_paper_tcm(const PipelineOptions& options) {
  if (options.merge_order == MergeOrder::kPaperTcm) return true;
  return options.profile == Profile::kPaper && options.merge_order != MergeOrder::kRobustTcm;
}

}  // namespace

Merging::Merging(const MergeInput& input, std::size_t reference, std::vector<bool> wanted)
    : in_(input),
      reference_(reference),
      wanted_(std::move(wanted)),
      placed_(input.scans.size(), false),
      T_reference_scan_(input.scans.size(), Eigen::Isometry3d::Identity()),
      tried_with_(input.scans.size(), 0),
      tried_guess_with_(input.scans.size(), 0),
      attempts_(input.scans.size(), 0),
      merged_(input.scans[reference].pyramid.level(0).voxel_size_m),
      target_((merged_.add(input.scans[reference].pyramid.level(0).cloud, Eigen::Isometry3d::Identity()),
               merged_.pyramid())),
      tcm_clouds_(input.scans.size()) {
  placed_[reference] = true;
}

void Merging::run(std::vector<MergeRecord>& records) {
  bool last_round = false;
  while (true) {
    // Weaker links are worth a trial when no other is left: S may show what a pair could not. Guesses come last:
    // nothing speaks for them but that a fit from there looks right.
    std::vector<Choice> open;
    for (const Source source : {Source::kStrongLinks, Source::kLinks, Source::kGuesses}) {
      if (open.empty()) open = choices(source);
    }
    if (open.empty()) {
      // Guessed scans have one more trial at the end, since annealing draws other numbers each time.
      const bool any_guess = std::any_of(in_.T_init.begin(), in_.T_init.end(), [](const auto& T) { return bool(T); });
      if (last_round || in_.options.profile == Profile::kPaper || num_merged_ == 1 || !any_guess) break;
      last_round = true;
      for (std::size_t i = 0; i < tried_with_.size(); ++i) {
        if (in_.T_init[i]) tried_guess_with_[i] = 0;
      }
      continue;
    }
    in_.context.report("merging", num_merged_, in_.scans.size());
    std::vector<MergeCandidate> candidates;
    for (const auto& choice : open) candidates.push_back({choice.scan, {}});
    compute_tcm(open, candidates);
    const std::size_t q = choose_next(open, candidates);
    const std::size_t before = num_merged_;
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (open[k].scan == q) merge(open[k], candidates[k].terms, records);
    }
    if (num_merged_ > before) last_round = false;
  }
}

std::vector<bool> Merging::unplaced() const {
  std::vector<bool> out(wanted_.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = wanted_[i] && !placed_[i];
  return out;
}

Eigen::Isometry3d Merging::guess(std::size_t scan) const {
  return in_.T_init[reference_].value_or(Eigen::Isometry3d::Identity()).inverse() *
         in_.T_init[scan].value_or(Eigen::Isometry3d::Identity());
}

bool Merging::may_guess(std::size_t scan) const {
  return in_.options.profile == Profile::kPaper || (in_.T_init[scan] && in_.T_init[reference_]);
}

std::vector<Merging::Choice> Merging::choices(Source source) {
  std::vector<Choice> out;
  for (std::size_t j = 0; j < in_.scans.size(); ++j) {
    if (!wanted_[j] || placed_[j]) continue;
    if (std::min(in_.scans[j].tcm_points.size(), in_.scans[reference_].tcm_points.size()) < kMinPoints) continue;
    if (source == Source::kGuesses) {
      // Tried again once S has grown.
      if (may_guess(j) && tried_guess_with_[j] < num_merged_) out.push_back({j, {{guess(j), 0, 0}}, true});
      continue;
    }
    std::vector<StartPose> starts =
        in_.graph.start_poses(j, placed_, T_reference_scan_, in_.scans[j].moments, same_m());
    const double least = source == Source::kLinks ? kMinLinkLogOdds : kStrongLogOdds;
    if (starts.empty() || starts.front().log_odds < least) continue;
    const std::size_t num_hypotheses = in_.graph.num_hypotheses(j, placed_);
    if (tried_with_[j] < num_hypotheses) out.push_back({j, std::move(starts), false});
  }
  return out;
}

void Merging::compute_tcm(const std::vector<Choice>& choices, std::vector<MergeCandidate>& candidates) {
  if (uses_paper_tcm(in_.options)) {
    const TcmCloud s(target_.level(0).cloud.points);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      candidates[k].terms = tcm_terms(s, TcmCloud(in_.scans[choices[k].scan].pyramid.level(0).cloud.points),
                                      choices[k].starts.front().T_reference_scan);
    }
    return;
  }
  // A choice is a scan, each scan once: no two threads fill in the same cloud.
  if (!merged_tcm_cloud_) merged_tcm_cloud_.emplace(target_.level(1).cloud.points, in_.options.tcm);
  parallel_for(in_.context.num_threads, candidates.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::optional<RobustTcmCloud>& cloud = tcm_clouds_[choices[k].scan];
      if (!cloud) cloud.emplace(in_.scans[choices[k].scan].tcm_points, in_.options.tcm);
      candidates[k].terms = robust_tcm_terms(*merged_tcm_cloud_, *cloud, choices[k].starts.front().T_reference_scan);
    }
  });
}

std::size_t Merging::choose_next(const std::vector<Choice>& choices, const std::vector<MergeCandidate>& candidates) {
  if (in_.options.merge_order == MergeOrder::kFile) return choices.front().scan;
  if (in_.options.merge_order == MergeOrder::kRandom) {
    Rng rng = make_stream(in_.context.seed, "merge order", std::to_string(num_choices_++));
    return choices[uniform_index(rng, choices.size())].scan;
  }
  if (in_.options.merge_order != MergeOrder::kOverlap) return next_scan_to_merge(candidates);
  const PyramidLevel& s = target_.level(1);
  std::size_t best = 0;
  double most = -1;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const PyramidLevel& scan = in_.scans[choices[k].scan].pyramid.level(1);
    const double mine = overlap({s.cloud.points, s.index}, {scan.cloud.points, scan.index},
                                choices[k].starts.front().T_reference_scan, 2 * s.voxel_size_m);
    if (mine > most) most = mine, best = k;
  }
  return choices[best].scan;
}

// Against the merged scans it was compared with: those it may share something with.
FreeSpaceEvidence Merging::free_space_at(std::size_t scan, const Eigen::Isometry3d& T) const {
  FreeSpaceEvidence sum;
  for (std::size_t i = 0; i < in_.scans.size(); ++i) {
    if (!placed_[i] || !in_.graph.links().contains({std::min(i, scan), std::max(i, scan)})) continue;
    sum += free_space(in_.scans[i], in_.scans[scan], T_reference_scan_[i].inverse() * T);
  }
  return sum;
}

// The fit, or a better pose nearby, may have left what the links lead to. Links that say little of a guess are not held
// against it; those that clearly lead elsewhere are.
void Merging::ask_links(const Choice& choice, const Eigen::Isometry3d& T, MergeRecord& record) {
  if (!record.evidence) return;
  const std::size_t scan = choice.scan;
  T_reference_scan_[scan] = T;
  const StartPose support = in_.graph.support(scan, placed_, T_reference_scan_, in_.scans[scan].moments, same_m());
  if (choice.by_guess && std::abs(support.log_odds) < kMinLinkLogOdds) return;
  record.evidence->link_log_odds = support.log_odds;
  record.evidence->num_links = support.num_links;
  const Verdict verdict = judge(*record.evidence, free_space_at(scan, T));
  record.accepted = verdict.accepted;
  record.reason = verdict.reason;
}

void Merging::merge(const Choice& choice, const TcmTerms& terms, std::vector<MergeRecord>& records) {
  const std::size_t q = choice.scan;
  const bool paper = in_.options.profile == Profile::kPaper;
  MergeRecord record;
  record.scan = q;
  record.attempt = ++attempts_[q];
  record.tcm = terms;
  Rng rng = make_stream(in_.context.seed, "placement", in_.files[q] + "#" + std::to_string(record.attempt));
  const Eigen::Isometry3d& T_first = choice.starts.front().T_reference_scan;
  Eigen::Isometry3d T;
  if (paper) {
    T = place_scan_as_printed(in_.scans[q], target_, T_first, in_.options, rng, record);
  } else {
    const FreeSpaceCheck check = [&](const Eigen::Isometry3d& pose) { return free_space_at(q, pose); };
    T = choice.by_guess ? place_scan(in_.scans[q], target_, T_first, in_.options, rng, record, check)
                        : place_linked_scan(in_.scans[q], target_, choice.starts, in_.options, rng, record, check);
    ask_links(choice, T, record);
  }
  if (choice.by_guess) {
    tried_guess_with_[q] = num_merged_;
  } else {
    tried_with_[q] = in_.graph.num_hypotheses(q, placed_);
  }
  if (record.accepted) {
    T_reference_scan_[q] = T;
    placed_[q] = true;
    merged_.add(in_.scans[q].pyramid.level(0).cloud, T);
    target_ = merged_.pyramid();
    merged_tcm_cloud_.reset();
    ++num_merged_;
  }
  in_.context.debug(in_.files[q] + (record.accepted ? " merged: " : " set aside: ") + record.reason);
  records.push_back(std::move(record));
}

}  // namespace tcm_icp
