#pragma once
// Scans are worked on in an order that comes from what they hold, and reported in the order in which they were given.

#include <cstddef>
#include <utility>
#include <vector>

#include "scans/scan_sampling.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// Positions of the scans in the list, by the number of their points, then by extent and spacing, which another frame
/// or unit does not change. In this order ties are broken and sums taken, so that neither names nor the order of the
/// list change a bit of any pose. Scans that are alike in all that go by name.
std::vector<std::size_t> order_by_content(const std::vector<SampledScan>& scans);

/// 0, 1, 2, ...
std::vector<std::size_t> order_of_list(std::size_t num_scans);

/// values[order[0]], values[order[1]], ...
template <typename T>
std::vector<T> in_order(std::vector<T> values, const std::vector<std::size_t>& order) {
  std::vector<T> out;
  out.reserve(values.size());
  for (const std::size_t i : order) out.push_back(std::move(values[i]));
  return out;
}

/// Makes the result for the scans in `order` one for the list: scans change places and numbers, pairs stay in their
/// order.
void restore_order(const std::vector<std::size_t>& order, PipelineResult& result);

}  // namespace tcm_icp
