#include "adjustment/adjustment.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "adjustment/scan_bending.hpp"
#include "registration/joint_normal_equations.hpp"
#include "registration/link_scores.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"
#include "tcm_icp/registration/joint_lp.hpp"

namespace tcm_icp {
namespace {

// What bounds the joint program: matches of a link, which also lets links weigh alike, and of all together. The exact
// solver's time grows with their square.
constexpr std::size_t kLpMatchesOfLink = 150;
constexpr std::size_t kLpMatches = 8'000;
constexpr std::size_t kLpMatchesExact = 600;
// Two links of a pair, an equation a match: fewer do not determine the six unknowns of the pair's pose, and the median
// of a link says nothing.
constexpr std::size_t kLeastLpMatchesOfLink = 3;

constexpr std::size_t kPairsOfScan = 8;
// Of the noise of matches: poses of a thousand matches are known to a thirtieth of it.
constexpr double kSettledMove = 0.01;

std::size_t lp_matches_of_link(std::size_t num_links, LpSolver solver) {
  const std::size_t all = solver == LpSolver::kCgal ? kLpMatchesExact : kLpMatches;
  return std::min(all / std::max<std::size_t>(1, num_links), kLpMatchesOfLink);
}

/// A scan is taken to be bent only where it is known where it was taken from. The scanner's axis is the direction that
/// its rays have least of: they go all around it, and less far up and down.
std::vector<ScanOrigin> origins_of(const std::vector<PreparedScan>& scans, bool is_wanted) {
  std::vector<ScanOrigin> out;
  for (const auto& scan : scans) {
    ScanOrigin& origin = out.emplace_back();
    if (!is_wanted || !(scan.sight.swept || scan.sight.sees_space())) continue;
    origin.located = true;
    origin.swept = scan.sight.swept;
    origin.place = scan.sight.places.front();
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const auto& point : scan.fine_sample.points) {
      const Eigen::Vector3d ray = (point - origin.place).stableNormalized();
      sum += ray * ray.transpose();
    }
    origin.axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
  }
  return out;
}

class Adjustment {
 public:
  Adjustment(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference, double block_m,
             bool bending, const L1FitOptions& lp, const RunContext& context,
             std::vector<Eigen::Isometry3d>& T_reference_scan)
      : scans_(scans),
        pairs_(pairs),
        reference_(reference),
        block_m_(block_m),
        lp_(lp),
        context_(context),
        T_reference_scan_(T_reference_scan),
        bending_(origins_of(scans, bending)) {}

  /// False where it has no solution, or is none: from some 250 scans on.
  bool lp_step(double gate_m) {
    const std::size_t most = lp_matches_of_link(2 * pairs_.size(), lp_.lp.solver);
    if (most < kLeastLpMatchesOfLink) {
      record_.lp_status = LpStatus::kSizeLimit;
      return false;
    }
    const std::vector<JointLink> links = thinned(match(gate_m), most);
    const std::vector<TwistFrame> frames = scan_frames(scans_, T_reference_scan_);
    JointLpOptions lp_options;
    lp_options.lp = lp_.lp;
    lp_options.tie_breaking = lp_.tie_breaking;
    lp_options.seed = context_.seed;
    const JointLpResult lp = solve_joint_lp(frames, reference_, links, lp_options);
    record_.lp += LpFigures{1, lp.pivots, lp.objective_m, lp.duality_gap, lp.seconds};
    record_.lp_status = lp.status;
    record_.num_lp_matches = lp.num_matches;
    if (!lp.optimal()) {
      context_.warn("a joint linear program ended with " + std::string(to_string(lp.status)) +
                    "; its step is left out");
      return false;
    }
    record_.lp_rms_move_m = move(frames, lp.steps_m);
    record_.outlying_pairs.clear();
    const std::vector<std::size_t> outlying = outlying_links(lp.link_medians_m, robust_noise_m(links));
    // A pair is two links, 2 k and 2 k + 1. A wrong pose shows in both, chance and a one-sided view in one.
    for (std::size_t i = 1; i < outlying.size(); ++i) {
      if (outlying[i] % 2 == 1 && outlying[i - 1] + 1 == outlying[i]) {
        record_.outlying_pairs.push_back(pairs_[outlying[i] / 2]);
      }
    }
    return true;
  }

  /// False where there is nothing to match or poses have settled, or where the equations have no solution.
  bool least_squares_step(double gate_m) {
    std::vector<JointLink> links = match(gate_m);
    bending_.set_poses(T_reference_scan_);
    for (auto& link : links) bending_.straighten(link);
    const double noise_m = robust_noise_m(links), threshold_m = kHuberFactor * noise_m;
    if (!(threshold_m > 0)) return false;
    const std::vector<TwistFrame> frames = scan_frames(scans_, T_reference_scan_);
    if (record_.num_steps == 0) {
      bending_.estimate(links, frames, {noise_m, block_m_}, context_.num_threads);
      record_.bending_m = bending_.offset_m();
      record_.motion_m = bending_.motion_m();
    }
    const Eigen::VectorXd x =
        bending_.any() ? solve_with_bending(links, frames, threshold_m) : solve_for_poses(links, frames, threshold_m);
    if (x.size() == 0) {
      context_.warn("the joint adjustment's equations could not be solved; poses stay as they were");
      return false;
    }
    const auto unknowns = x.size() / static_cast<Eigen::Index>(scans_.size());
    std::vector<Twist> steps_m(scans_.size());
    for (std::size_t i = 0; i < steps_m.size(); ++i) {
      const auto first = static_cast<Eigen::Index>(i) * unknowns;
      steps_m[i] = x.segment<kPoseUnknowns>(first);
      if (bending_.any()) bending_.add_step(i, x.segment<kBendUnknowns>(first + kPoseUnknowns));
    }
    record_.rms_move_m = move(frames, steps_m);
    ++record_.num_steps;
    return record_.rms_move_m > kSettledMove * noise_m;
  }

  const AdjustmentRecord& record() const { return record_; }

 private:
  std::vector<JointLink> match(double gate_m) const {
    return match_pairs(scans_, pairs_, T_reference_scan_, gate_m, context_.num_threads);
  }

  /// Steps of all unknowns, scan by scan; empty where there is no solution.
  Eigen::VectorXd solve_for_poses(const std::vector<JointLink>& links, const std::vector<TwistFrame>& frames,
                                  double threshold_m) const {
    JointNormalEquations equations(frames, reference_);
    add_sums<PoseSums>(equations, links, [&](const JointLink& link) {
      return huber_sums(link, frames[link.target], frames[link.source], threshold_m);
    });
    return equations.solve();
  }

  Eigen::VectorXd solve_with_bending(const std::vector<JointLink>& links, const std::vector<TwistFrame>& frames,
                                     double threshold_m) const {
    JointNormalEquations equations(frames, reference_, kBentUnknowns);
    add_sums<BentSums>(equations, links, [&](const JointLink& link) {
      return bending_.sums(link, frames[link.target], frames[link.source], threshold_m);
    });
    bending_.add_prior(equations);
    return equations.solve();
  }

  template <typename Sums, typename SumsOf>
  void add_sums(JointNormalEquations& equations, const std::vector<JointLink>& links, const SumsOf& sums_of) const {
    std::vector<Sums> sums(links.size());
    parallel_for(context_.num_threads, links.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) sums[k] = sums_of(links[k]);
    });
    for (std::size_t k = 0; k < links.size(); ++k) equations.add(links[k], sums[k]);
  }

  /// Root mean square [m] over the scans.
  double move(const std::vector<TwistFrame>& frames, const std::vector<Twist>& steps_m) {
    double sum_m2 = 0;
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      if (i == reference_ || steps_m[i].isZero()) continue;
      T_reference_scan_[i] = frames[i].moved(T_reference_scan_[i], steps_m[i]);
      sum_m2 += steps_m[i].squaredNorm();
    }
    return std::sqrt(sum_m2 / static_cast<double>(scans_.size()));
  }

  const std::vector<PreparedScan>& scans_;
  const ScanPairs& pairs_;
  std::size_t reference_;
  double block_m_;
  const L1FitOptions& lp_;
  const RunContext& context_;
  std::vector<Eigen::Isometry3d>& T_reference_scan_;
  AdjustmentRecord record_;
  ScanBending bending_;
};

}  // namespace

ScanPairs overlapping_pairs(const std::vector<PreparedScan>& scans,
                            const std::vector<Eigen::Isometry3d>& T_reference_scan, const std::vector<bool>& placed,
                            double min_overlap, int num_threads) {
  ScanPairs candidates;
  for (std::size_t a = 0; a < scans.size(); ++a) {
    if (!placed[a]) continue;
    const double distance_m = scans[a].pyramid.level(1).voxel_size_m;
    for (std::size_t b = a + 1; b < scans.size(); ++b) {
      if (!placed[b]) continue;
      if (may_meet(scans[a], scans[b], T_reference_scan[a].inverse() * T_reference_scan[b], distance_m)) {
        candidates.emplace_back(a, b);
      }
    }
  }
  std::vector<double> shares(candidates.size(), 0);
  parallel_for(num_threads, candidates.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = candidates[i];
      const PyramidLevel& level_a = scans[a].pyramid.level(1);
      const PyramidLevel& level_b = scans[b].pyramid.level(1);
      shares[i] = overlap(level_a, level_b, T_reference_scan[a].inverse() * T_reference_scan[b], level_a.voxel_size_m);
    }
  });
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) { return shares[x] > shares[y]; });
  std::vector<std::size_t> num_pairs(scans.size(), 0);
  std::vector<std::size_t> kept;
  for (const std::size_t i : order) {
    if (shares[i] < min_overlap) break;
    const auto [a, b] = candidates[i];
    if (std::min(num_pairs[a], num_pairs[b]) >= kPairsOfScan) continue;
    ++num_pairs[a];
    ++num_pairs[b];
    kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  ScanPairs pairs;
  for (const std::size_t i : kept) pairs.push_back(candidates[i]);
  return pairs;
}

AdjustmentRecord adjust_poses(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                              const Resolutions& resolutions, const AdjustmentOptions& options, const L1FitOptions& lp,
                              const RunContext& context, std::vector<Eigen::Isometry3d>& T_reference_scan,
                              StartingPoses from) {
  Adjustment adjustment(scans, pairs, reference, resolutions.fine_m, options.bending, lp, context, T_reference_scan);
  const int lp_steps = options.lp_steps, steps = options.steps;
  const double first_m = kGateInVoxels * resolutions.coarse_m, last_m = kGateInVoxels * resolutions.fine_m;
  const auto gate_m = [&](double share) { return first_m * std::pow(last_m / first_m, std::min(1.0, share)); };
  int done = 0;
  const auto report = [&] {
    context.report("adjusting", static_cast<std::size_t>(done++), static_cast<std::size_t>(lp_steps + steps));
  };
  bool is_near = from == StartingPoses::kAdjusted;
  for (int step = 0; step < lp_steps && !pairs.empty(); ++step) {
    report();
    is_near |= adjustment.lp_step(gate_m(static_cast<double>(step) / std::max(1, lp_steps - 1)));
  }
  for (int step = 0; step < steps; ++step) {
    report();
    // The gate reaches its last size half-way, so that the second half settles; programs have brought it there.
    const double share = is_near ? 1 : 2.0 * step / std::max(1, steps - 1);
    if (!adjustment.least_squares_step(gate_m(share))) break;
  }
  return adjustment.record();
}

}  // namespace tcm_icp
