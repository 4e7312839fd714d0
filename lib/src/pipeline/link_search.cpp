#include "link_search.hpp"

#include <algorithm>

#include "link_score.hpp"
#include "pose_search.hpp"
#include "scan_sight.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/alignment_objective.hpp"
#include "tcm_icp/registration/lp_registration.hpp"

namespace tcm_icp {
namespace {

// A pair is looked at by few points: its fit is taken up again when the scan is merged.
constexpr std::size_t kFitPoints = 500, kVerifyPoints = 500, kScreenPoints = 250;
constexpr std::size_t kMaxFits = 3;
constexpr int kMaxPrograms = 20;  // a fit of a right pose takes ten; others go round in circles
constexpr double kFirstGate = 8, kLastGate = 2, kGateShrink = 0.6;  // gates in coarse voxels

// Free space tells before a fit: right poses of real scenes, off by up to four coarse voxels, came to 0.04 of
// violations and less, those whose fits were wrong to 0.08 and more.
constexpr double kHopelessViolations = 0.12;

// A slide is right but for two voxels or so, or wrong.
constexpr double kHopelessOfSlide = 0.04;

bool hopeless(const PreparedScan& target, const PreparedScan& source, const PoseCandidate& candidate) {
  const FreeSpaceEvidence evidence = free_space(target, source, candidate.T_target_source);
  const double most = candidate.method == CoarseMethod::kSlide ? kHopelessOfSlide : kHopelessViolations;
  return evidence.tells() && evidence.violation_share() > most;
}

// Each method's best, then those whose points lie nearest the target. Points alone would not do: in a forest something
// is near everywhere.
std::vector<PoseCandidate> screen(const PreparedScan& target, const PreparedScan& source,
                                  const std::vector<PoseCandidate>& candidates) {
  const Cloud sample = even_sample(source.coarse_sample, kScreenPoints);
  const double voxel_m = target.pyramid.level(0).voxel_size_m;
  const AlignmentObjective objective(sample, target.pyramid.level_for(4 * voxel_m), 2 * voxel_m, kFirstGate * voxel_m);
  struct Rank {
    bool not_best;
    double cost;
    std::size_t index;
    auto operator<=>(const Rank&) const = default;
  };
  std::vector<Rank> ranks;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool best = std::none_of(candidates.begin(), candidates.end(), [&](const PoseCandidate& c) {
      return c.method == candidates[i].method && c.score > candidates[i].score;
    });
    ranks.push_back({!best, objective.cost(candidates[i].T_target_source), i});
  }
  std::sort(ranks.begin(), ranks.end());
  std::vector<PoseCandidate> out;
  for (const Rank& rank : ranks) out.push_back(candidates[rank.index]);
  return out;
}

AlignmentEvidence evidence_of(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b) {
  const auto one_way = [&](const PreparedScan& target, const PreparedScan& source, const Eigen::Isometry3d& T,
                           bool with_slides) {
    VerificationOptions options = verification_at(target.pyramid.level(0).voxel_size_m);
    options.with_slides = with_slides;
    return verify_alignment(even_sample(source.held_out_sample, kVerifyPoints), target.pyramid.level(0), T, options);
  };
  // The direction that sees more of the other scan speaks for the pair: only there are slides worth their time.
  const double b_in_a = one_way(a, b, T_a_b, false).overlap, a_in_b = one_way(b, a, T_a_b.inverse(), false).overlap;
  AlignmentEvidence evidence = b_in_a >= a_in_b ? one_way(a, b, T_a_b, true) : one_way(b, a, T_a_b.inverse(), true);
  evidence.runner_up = 0;  // asked when the scan is merged
  return evidence;
}

}  // namespace

void CandidateLink::rank(const PointMoments& points_b, double voxel_m) {
  for (auto& h : hypotheses) {
    double rival = 0;
    for (const auto& other : hypotheses) {
      if (other.free_space.vetoes()) continue;
      const double apart_m = rms_displacement(h.T_a_b.inverse() * other.T_a_b, points_b);
      if (apart_m >= kSameLinkPose * voxel_m) rival = std::max(rival, other.evidence.consensus());
    }
    h.log_odds = link_log_odds(h.evidence, h.candidate, voxel_m) + free_space_log_odds(h.free_space) +
                 rival_log_odds(h.evidence.consensus(), rival);
    if (h.free_space.vetoes()) h.log_odds = std::min(h.log_odds, kVetoedLogOdds);
  }
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const LinkHypothesis& x, const LinkHypothesis& y) { return x.log_odds > y.log_odds; });
}

void CandidateLink::swap() {
  std::swap(a, b);
  for (auto& h : hypotheses) {
    h.T_a_b = h.T_a_b.inverse();
    h.candidate.T_target_source = h.candidate.T_target_source.inverse();
  }
}

CandidateLink fit_candidates(const std::vector<PreparedScan>& scans, std::size_t a, std::size_t b,
                             const std::vector<PoseCandidate>& candidates, const PipelineOptions& options) {
  CandidateLink link{a, b, {}};
  const PreparedScan& target = scans[a];
  const PreparedScan& source = scans[b];
  const double voxel_m = target.pyramid.level(0).voxel_size_m;
  const Cloud sample = even_sample(source.coarse_sample, kFitPoints);
  LpRegistrationOptions lp;
  lp.formulation = options.placement.formulation;
  lp.lp = options.lp;
  lp.initial_gate_m = kFirstGate * voxel_m;
  lp.final_gate_m = kLastGate * voxel_m;
  lp.gate_shrink = kGateShrink;
  lp.max_iterations = kMaxPrograms;
  std::size_t num_fits = 0, num_vetoed = 0;
  for (const auto& candidate : screen(target, source, candidates)) {
    if (num_fits - num_vetoed == kMaxFits) break;
    if (hopeless(target, source, candidate)) continue;
    ++num_fits;
    const RegistrationResult fit = register_lp(sample, target.pyramid, candidate.T_target_source, lp);
    if (!fit.usable()) continue;
    const bool known = std::any_of(link.hypotheses.begin(), link.hypotheses.end(), [&](const auto& h) {
      return rms_displacement(h.T_a_b.inverse() * fit.T_target_source, sample.points) < kSearchGridStep / 2 * voxel_m;
    });
    if (known) continue;
    LinkHypothesis hypothesis{fit.T_target_source, candidate, evidence_of(target, source, fit.T_target_source), 0};
    hypothesis.free_space = free_space(target, source, fit.T_target_source);
    hypothesis.log_odds =
        link_log_odds(hypothesis.evidence, candidate, voxel_m) + free_space_log_odds(hypothesis.free_space);
    link.hypotheses.push_back(hypothesis);
    if (hypothesis.free_space.vetoes()) {
      ++num_vetoed;
      continue;
    }
    if (hypothesis.log_odds >= kClearLogOdds) break;  // the others cannot beat it
  }
  link.rank(sample.points, voxel_m);
  return link;
}

}  // namespace tcm_icp
