#pragma once
// Order statistics.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tcm_icp {

/// The value with a share of `share` (0..1) of the others below it. Reorders the values. O(N).
/// @pre values is not empty
inline double quantile(std::vector<double>& values, double share) {
  const auto k = std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(k);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The upper median. Reorders the values. O(N).
/// @pre values is not empty
inline double median(std::vector<double>& values) { return quantile(values, 0.5); }

/// Median of the magnitudes that are not zero but for rounding, which are those above a billionth of the largest; 0
/// where all are 0. Of the residuals of an L1 fit as many as it has unknowns are zero, some of them but for rounding.
/// O(N).
inline double median_nonzero(std::vector<double> magnitudes) {
  constexpr double kRoundingShare = 1e-9;
  if (magnitudes.empty()) return 0;
  const double largest = *std::max_element(magnitudes.begin(), magnitudes.end());
  std::erase_if(magnitudes, [&](double value) { return !(value > kRoundingShare * largest); });
  return magnitudes.empty() ? 0 : median(magnitudes);
}

/// Standard deviation of normal errors, by the median of their absolute values.
constexpr double kMadToSigma = 1.4826;

}  // namespace tcm_icp
