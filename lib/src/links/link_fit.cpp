#include "links/link_fit.hpp"

#include <algorithm>
#include <utility>

#include "core/acceptance.hpp"
#include "links/measure_link.hpp"
#include "scans/matched_sides.hpp"
#include "scans/scan_sight.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/alignment_objective.hpp"
#include "tcm_icp/registration/lp_registration.hpp"

namespace tcm_icp {
namespace {

// With 500 points to fit and to measure, another seed moved the log-odds of right pairs over a forest by 1.3 (standard
// deviation); with 1,500 by 0.55, for 5 % more time.
constexpr std::size_t kFitPoints = 1500, kScreenPoints = 250;
constexpr int kMaxLpSolves = 20;  // a fit of a right pose takes five to eight
// Maximum correspondence distances, in coarse voxels.
constexpr double kFirstDistance = 8, kLastDistance = 2, kDistanceShrink = 0.6;
// Matches from far away draw a pose to where the scans overlap more. A fit that ends farther off than its candidate may
// be is tried again by matches within twice that.
constexpr double kAccuracies = 2;

bool hopeless(const PreparedScan& target, const PreparedScan& source, const PoseCandidate& candidate) {
  const FreeSpaceEvidence evidence = violations(target, source, candidate.T_target_source);
  const double most = candidate.method == CoarseMethod::kSlide ? kHopelessOfSlide : kHopelessViolations;
  return evidence.tells() && evidence.violation_share() > most;
}

std::optional<LinkHypothesis> fit_from(double first_distance_m, const PreparedScan& target, const PreparedScan& source,
                                       const PoseCandidate& candidate, const LinkSearchOptions& options) {
  const double voxel_m = target.pyramid.level(0).voxel_size_m;
  LpRegistrationOptions lp;
  lp.formulation = options.formulation;
  lp.lp = options.lp;
  lp.initial_gate_m = first_distance_m;
  lp.final_gate_m = kLastDistance * voxel_m;
  lp.gate_shrink = kDistanceShrink;
  lp.max_iterations = kMaxLpSolves;
  const RegistrationResult fit =
      register_lp(even_sample(source.coarse_sample, kFitPoints), target.pyramid, candidate.T_target_source, lp,
                  [&](const Eigen::Isometry3d& T_target_source, Correspondences& matches) {
                    drop_opposed(target.sight, source.sight, T_target_source, matches);
                  });
  if (!fit.usable()) return std::nullopt;
  return LinkHypothesis{fit.T_target_source, candidate, measure_link(target, source, fit.T_target_source)};
}

// Along a corridor points agree most where both scans overlap most, which is where walls are seen through.
bool is_better(const LinkMeasurements& a, const LinkMeasurements& b) {
  return a.evidence.consensus() > b.evidence.consensus() &&
         a.free_space.violation_share() <= b.free_space.violation_share();
}

// Along a corridor points lie nearest where both scans overlap most. Where both were taken free space tells far better
// how far apart that was, and then the votes.
std::vector<PoseCandidate> slides_in_order(const PreparedScan& target, const PreparedScan& source,
                                           std::vector<PoseCandidate> slides) {
  std::stable_sort(slides.begin(), slides.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::stable_partition(slides.begin(), slides.end(), [&](const PoseCandidate& c) {
    return !violations(target, source, c.T_target_source).vetoes();
  });
  return slides;
}

}  // namespace

std::vector<PoseCandidate> in_order_of_promise(const PreparedScan& target, const PreparedScan& source,
                                               const std::vector<PoseCandidate>& candidates) {
  if (!candidates.empty() && candidates.front().method == CoarseMethod::kSlide) {
    return slides_in_order(target, source, candidates);
  }
  // Points alone would not do: in a forest something is near everywhere.
  const Cloud sample = even_sample(source.coarse_sample, kScreenPoints);
  const double voxel_m = target.pyramid.level(0).voxel_size_m;
  const AlignmentObjective objective(sample, target.pyramid.level_for(4 * voxel_m), 2 * voxel_m,
                                     kFirstDistance * voxel_m);
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

std::optional<LinkHypothesis> fit_candidate(const PreparedScan& target, const PreparedScan& source,
                                            const PoseCandidate& candidate, const LinkSearchOptions& options) {
  if (hopeless(target, source, candidate)) return std::nullopt;
  const double voxel_m = target.pyramid.level(0).voxel_size_m;
  const double least_m = kLastDistance * voxel_m, most_m = kFirstDistance * voxel_m;
  auto fit = fit_from(candidate.there ? least_m : most_m, target, source, candidate, options);
  const double near_m = std::max(kAccuracies * candidate.accuracy_m, least_m);
  const double off_m = std::max(candidate.accuracy_m, voxel_m);  // and what the fit itself may be off
  const bool is_off =
      !fit || rms_displacement(candidate.T_target_source.inverse() * fit->T_a_b, source.moments) > off_m;
  if (candidate.accuracy_m > 0 && near_m < most_m && is_off) {
    auto near = fit_from(near_m, target, source, candidate, options);
    if (near && (!fit || is_better(near->measurements, fit->measurements))) fit = std::move(near);
  }
  return fit;
}

}  // namespace tcm_icp
