#pragma once
// Order statistics.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tcm_icp {

/// The value below which `share` (0..1) of the values lie. Reorders them. @pre values is not empty
inline double quantile(std::vector<double>& values, double share) {
  const auto k = std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(k);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace tcm_icp
