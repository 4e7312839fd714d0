#include "link_score.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

// Shares, margins and residuals beyond these say no more. A margin is infinite where no other pose was found.
constexpr double kLeastShare = 0.01, kLeastResidual = 0.001, kMostLeft = 2;
constexpr double kLeastMargin = 0.1, kMostMargin = 10;

double log_of(double value, double least) { return std::log(std::max(value, least)); }

double coarse_log_odds(const PoseCandidate& candidate) {
  const double margin = log_of(std::min(candidate.margin, kMostMargin), kLeastMargin);
  switch (candidate.method) {
    case CoarseMethod::kHeightMap:
      return 4.36 * margin;
    case CoarseMethod::kFeatures:
      return -1.24 + 1.96 * margin;
    case CoarseMethod::kSlide:
      return -1.24;  // as features that tie with others: lengths of a slide are voted for by what repeats itself, too
  }
  return 0;
}

}  // namespace

double link_log_odds(const AlignmentEvidence& evidence, const PoseCandidate& candidate, double voxel_m) {
  double mean_left = 0;
  for (const double left : evidence.left_after_slide) mean_left += left / 6;
  return 8.13 + 3.70 * log_of(evidence.overlap, kLeastShare) + 2.67 * log_of(evidence.inlier_share, kLeastShare) -
         4.95 * std::min(evidence.left_after_slide[0], kMostLeft) - 6.42 * std::min(mean_left, kMostLeft) -
         2.77 * log_of(evidence.median_residual_m / voxel_m, kLeastResidual) + coarse_log_odds(candidate);
}

double rival_log_odds(double consensus, double rival_consensus) {
  constexpr double kLeastConsensus = 0.001;
  return 3 * std::min(0.0, log_of(consensus, kLeastConsensus) - log_of(rival_consensus, kLeastConsensus));
}

double free_space_log_odds(const FreeSpaceEvidence& free_space) {
  constexpr double kViolating = 0.004, kPerViolating = 500, kOpposed = 0.03, kPerOpposed = 40;
  // Beyond what right poses have, less a standard deviation of the count.
  const auto beyond = [](std::size_t part, std::size_t all, double usual) {
    const auto count = static_cast<double>(part);
    return all == 0 ? 0 : std::max(0.0, (count - std::sqrt(count)) / static_cast<double>(all) - usual);
  };
  if (!free_space.tells()) return 0;
  return -kPerViolating * beyond(free_space.num_violating, free_space.num_points, kViolating) -
         kPerOpposed * beyond(free_space.num_opposed, free_space.num_matches, kOpposed);
}

double misfit_log_odds(double residual_m, double typical_residual_m) {
  if (!(typical_residual_m > 0)) return 0;
  return -4 * std::max(0.0, std::log(residual_m / typical_residual_m / 2));
}

}  // namespace tcm_icp
