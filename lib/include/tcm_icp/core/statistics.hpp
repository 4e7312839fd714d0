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

/// Standard deviation of normal errors, by the median of their absolute values.
constexpr double kMadToSigma = 1.4826;

}  // namespace tcm_icp
