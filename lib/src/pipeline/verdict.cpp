#include "verdict.hpp"

#include <cmath>
#include <cstdio>
#include <string>

#include "link_score.hpp"

namespace tcm_icp {
namespace {

std::string percent(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
  return text;
}

// A pose that a wide search came up with is one of many it looked at, so more is asked of it: it must be sharp, or most
// of the scan must have a counterpart. A mirrored scan of a flat campus, which no motion can place, reached 0.60 with
// 0.60 of its points overlapping.
constexpr double kMaxLeftAfterSlideSearched = 0.55;
constexpr double kMinOverlapSearched = 2.0 / 3;
// Neighbours at random lie within a quarter voxel of the plane, normals agreeing, in 5 to 15 % of cases.
constexpr double kMinInlierShare = 0.2;
constexpr double kMaxRunnerUp = 0.85;
constexpr double kMinConsensus = 0.05;
constexpr std::size_t kMinAgreeing = 30;
constexpr double kMaxLeftAcross = 0.5;

}  // namespace

bool may_be_held_across(const AlignmentEvidence& evidence) {
  return evidence.num_across >= kMinAgreeing && evidence.left_across <= kMaxLeftAcross;
}

bool held_across(const AlignmentEvidence& evidence, const FreeSpaceEvidence& free_space) {
  return may_be_held_across(evidence) && free_space.tells() && free_space_log_odds(free_space) > kBorneOut;
}

VerificationOptions verification_at(double voxel_m) {
  VerificationOptions options;
  options.gate_m = 2 * voxel_m;
  options.tolerance_m = voxel_m / 4;
  options.slide_m = 4 * voxel_m;
  return options;
}

Verdict judge(const AlignmentEvidence& evidence, const FreeSpaceEvidence& free_space) {
  const double agreeing = evidence.consensus() * static_cast<double>(evidence.num_points);
  if (agreeing < static_cast<double>(kMinAgreeing) || evidence.consensus() < kMinConsensus) {
    return {false, "only " + percent(evidence.consensus()) + " of the points agree with the other scans"};
  }
  if (evidence.inlier_share < kMinInlierShare) {
    return {false, "only " + percent(evidence.inlier_share) + " of the overlap is within the noise"};
  }
  if (evidence.runner_up > kMaxRunnerUp) {
    return {false, "ambiguous: another pose nearby has " + percent(evidence.runner_up) + " of the agreement"};
  }
  if (evidence.link_log_odds < kMinLinkLogOdds) {
    return {false, "links to its neighbours contradict one another, or none stands out"};
  }
  const bool linked = !std::isnan(evidence.link_log_odds);
  const bool strict = evidence.searched && !linked && evidence.overlap < kMinOverlapSearched;
  const double max_left = strict ? kMaxLeftAfterSlideSearched : kMaxLeftAfterSlide;
  if (evidence.left_after_slide[0] > max_left && !held_across(evidence, free_space)) {
    return {false, "ambiguous: moved along its weakest direction, it still agrees at " +
                       percent(evidence.left_after_slide[0]) + " of as many points"};
  }
  if (free_space.vetoes()) {
    return {false, "seen through walls: " + percent(free_space.violation_share()) +
                       " of what it and its neighbours share lies before surfaces the other saw, " +
                       percent(free_space.opposed_share()) + " was seen from opposite sides"};
  }
  return {true, percent(evidence.consensus()) + " of the points agree; " + percent(evidence.left_after_slide[0]) +
                    " of that is left when it slides along its weakest direction"};
}

}  // namespace tcm_icp
