#include "tcm_icp/links/link_measurements.hpp"

#include <algorithm>
#include <cmath>

#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr double kBestQuantile = 0.95, kBetterShare = 0.1;
constexpr double kLeastShare = 0.01;    // less overlaps or agrees by chance
constexpr double kMostLeft = 2;         // a slide that doubles the agreement: the pose is no optimum
constexpr double kMostRatio = 10;       // of two measurements that are compared
constexpr std::size_t kFewAcross = 30;  // points: with fewer a share is chance
constexpr std::size_t kFewMatches = 100;
// Violations and opposite sides that noise and thin things make at right poses, of which more begins to tell.
constexpr double kUsualViolations = 0.004, kUsualOpposed = 0.03;

double log_share(double share) { return std::log(std::max(share, kLeastShare)); }

double log_ratio(double a, double b) {
  if (!(b > 0)) return 0;
  return std::log(std::clamp(a / b, 1 / kMostRatio, kMostRatio));
}

// Logarithm of a count's share by the usual one, less a standard deviation of the count: few points prove little.
double beyond(std::size_t part, std::size_t all, double usual) {
  const auto count = static_cast<double>(part);
  return std::log1p((count - std::min(count, std::sqrt(count))) / static_cast<double>(all) / usual);
}

}  // namespace

SetReference SetReference::of(double voxel_m, double noise_m, const std::vector<LinkMeasurements>& hypotheses) {
  SetReference set{voxel_m, noise_m, 1, voxel_m};
  if (hypotheses.empty()) return set;
  std::vector<double> shares;
  std::vector<const AlignmentEvidence*> order;
  for (const auto& h : hypotheses) {
    shares.push_back(h.evidence.inlier_share);
    order.push_back(&h.evidence);
  }
  set.best_inlier_share = quantile(shares, kBestQuantile);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* x, const auto* y) { return x->consensus() > y->consensus(); });
  std::vector<double> residuals_m;
  const auto better = static_cast<std::size_t>(std::ceil(kBetterShare * static_cast<double>(order.size())));
  for (std::size_t i = 0; i < better; ++i) residuals_m.push_back(order[i]->median_residual_m);
  set.typical_residual_m = median(residuals_m);
  return set;
}

LinkFeatures link_features(const LinkMeasurements& m, const std::optional<SearchMeasurements>& search,
                           const SetReference& set) {
  const AlignmentEvidence& e = m.evidence;
  double mean_left = 0;
  for (const double left : e.left_after_slide) mean_left += std::min(left, kMostLeft) / 6;
  const bool across = e.num_across >= kFewAcross, space = m.free_space.tells();
  const bool sides = m.free_space.num_matches >= kFewMatches;
  LinkFeatures f{};
  f[0] = log_share(e.overlap);
  f[1] = log_share(m.other_overlap);
  f[2] = log_share(e.inlier_share);
  f[3] = log_share(m.other_inlier_share);
  f[4] = log_ratio(std::max(e.inlier_share, kLeastShare), set.best_inlier_share);
  f[5] = log_ratio(e.median_residual_m, set.voxel_m / kMostRatio);
  f[6] = log_ratio(e.median_residual_m, set.typical_residual_m);
  f[7] = log_ratio(set.voxel_m / kMostRatio, set.noise_m);
  f[8] = std::min(e.left_after_slide[0], kMostLeft);
  f[9] = mean_left;
  f[10] = across ? std::min(e.left_across, kMostLeft) : 0;
  f[11] = across ? 0 : 1;
  f[12] = space ? beyond(m.free_space.num_violating, m.free_space.num_points, kUsualViolations) : 0;
  f[13] = sides ? beyond(m.free_space.num_opposed, m.free_space.num_matches, kUsualOpposed) : 0;
  f[14] = space ? 0 : 1;
  if (!search) return f;
  const double margin = std::log(std::clamp(search->margin, 1 / kMostRatio, kMostRatio));
  f[15] = search->second_best_ratio > 0 ? log_ratio(1, search->second_best_ratio) : std::log(kMostRatio);
  f[16] = search->method == CoarseMethod::kHeightMap ? margin : 0;
  f[17] = search->method == CoarseMethod::kHeightMap ? 1 : 0;
  f[18] = search->method == CoarseMethod::kFeatures ? margin : 0;
  f[19] = search->method == CoarseMethod::kSlide ? 1 : 0;
  return f;
}

}  // namespace tcm_icp
