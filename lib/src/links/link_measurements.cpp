#include "tcm_icp/links/link_measurements.hpp"

#include <algorithm>
#include <cmath>

#include "links/feature_scales.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr double kBestQuantile = 0.95, kBetterShare = 0.1;

// A pose that no search proposed has no rival either where nobody looked for one: that says nothing for it.
double second_best(const SearchMeasurements& search) {
  if (search.second_best_ratio > 0) return log_ratio(1, search.second_best_ratio);
  const bool searched = search.method != CoarseMethod::kGuess && search.method != CoarseMethod::kImplied;
  return searched ? std::log(kMostRatio) : 0;
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
  LinkFeatures f{};
  f[0] = log_share(e.overlap);
  f[1] = log_share(m.other_overlap);
  f[2] = log_share(e.inlier_share);
  f[3] = log_share(m.other_inlier_share);
  f[4] = log_ratio(std::max(e.inlier_share, kLeastShare), set.best_inlier_share);
  f[5] = log_ratio(e.median_residual_m, set.voxel_m / kMostRatio);
  f[6] = log_ratio(e.median_residual_m, set.typical_residual_m);
  f[7] = log_ratio(set.voxel_m / kMostRatio, set.noise_m);
  f[8] = weakest_left(e);
  f[9] = mean_left(e);
  f[10] = left_across(e);
  f[11] = tells_across(e) ? 0 : 1;
  f[12] = violations(m.free_space);
  f[13] = opposed(m.free_space);
  f[14] = !m.free_space.tells() && m.sighted ? 1 : 0;
  f[15] = held_by_space(m.free_space, m.slid_space);
  f[16] = m.free_space.tells() && !tells_slid(m.slid_space) ? 1 : 0;
  f[17] = !m.free_space.tells() && !m.sighted ? 1 : 0;
  if (!search) return f;
  const double margin = std::log(std::clamp(search->margin, 1 / kMostRatio, kMostRatio));
  f[18] = second_best(*search);
  f[19] = search->method == CoarseMethod::kHeightMap ? margin : 0;
  f[20] = search->method == CoarseMethod::kHeightMap ? 1 : 0;
  f[21] = search->method == CoarseMethod::kFeatures ? margin : 0;
  f[22] = search->method == CoarseMethod::kSlide ? 1 : 0;
  f[23] = search->method == CoarseMethod::kImplied || search->method == CoarseMethod::kGuess ? 1 : 0;
  return f;
}

}  // namespace tcm_icp
