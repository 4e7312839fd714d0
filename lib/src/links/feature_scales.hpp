#pragma once
// Measurements as numbers without a unit, within bounds beyond which they say no more. Those that link and scan have in
// common are scaled alike.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tcm_icp/registration/verification.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

constexpr double kLeastShare = 0.01;    // less overlaps or agrees by chance
constexpr double kMostLeft = 2;         // a slide that doubles the agreement: the pose is no optimum
constexpr double kMostRatio = 10;       // of two measurements that are compared
constexpr std::size_t kFewAcross = 30;  // points: with fewer a share is chance
constexpr std::size_t kFewMatches = 100;
constexpr std::size_t kFewSlid = 30;  // the ratio of shares has its own allowance for chance
// Violations and opposite sides that noise and thin things make at right poses, of which more begins to tell.
constexpr double kUsualViolations = 0.004, kUsualOpposed = 0.03;

inline double log_share(double share) { return std::log(std::max(share, kLeastShare)); }

inline double log_ratio(double a, double b) {
  return b > 0 ? std::log(std::clamp(a / b, 1 / kMostRatio, kMostRatio)) : 0;
}

inline double weakest_left(const AlignmentEvidence& e) { return std::min(e.left_after_slide[0], kMostLeft); }

inline double mean_left(const AlignmentEvidence& e) {
  double sum = 0;
  for (const double left : e.left_after_slide) sum += std::min(left, kMostLeft);
  return sum / static_cast<double>(e.left_after_slide.size());
}

inline bool tells_across(const AlignmentEvidence& e) { return e.num_across >= kFewAcross; }

inline double left_across(const AlignmentEvidence& e) {
  return tells_across(e) ? std::min(e.left_across, kMostLeft) : 0;
}

/// Logarithm of a count's share by the usual one, less a standard deviation of the count: few points prove little.
inline double beyond(std::size_t part, std::size_t all, double usual) {
  const auto count = static_cast<double>(part);
  return std::log1p((count - std::min(count, std::sqrt(count))) / static_cast<double>(all) / usual);
}

inline double violations(const FreeSpaceEvidence& e) {
  return e.tells() ? beyond(e.num_violating, e.num_points, kUsualViolations) : 0;
}

/// Where scans overlap little a slide takes them apart, and nothing is left that could be seen through.
inline bool tells_slid(const FreeSpaceEvidence& slid) { return slid.num_points >= kFewSlid; }

/// Logarithm of how many times more is seen through after a slide, at least, than here, at most: a standard deviation
/// of the counts is left to chance. 0 where as much is, or few points tell.
inline double held_by_space(const FreeSpaceEvidence& here, const FreeSpaceEvidence& slid) {
  if (!here.tells() || !tells_slid(slid)) return 0;
  const auto after = static_cast<double>(slid.num_violating), before = static_cast<double>(here.num_violating + 1);
  const double least = (after - std::min(after, std::sqrt(after))) / static_cast<double>(slid.num_points);
  const double most = (before + std::sqrt(before)) / static_cast<double>(here.num_points);
  return std::max(0.0, log_ratio(kUsualViolations + least, kUsualViolations + most));
}

inline double opposed(const FreeSpaceEvidence& e) {
  return e.num_matches >= kFewMatches ? beyond(e.num_opposed, e.num_matches, kUsualOpposed) : 0;
}

}  // namespace tcm_icp
