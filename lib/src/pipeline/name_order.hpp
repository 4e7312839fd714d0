#pragma once
// Scans are worked on in the order of their names, and reported in the order in which they were given.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// Positions of the files in the list, by file name. In this order ties are broken, random numbers drawn and sums
/// taken, so that the order of the list changes no bit of any pose.
std::vector<std::size_t> order_by_name(const std::vector<std::filesystem::path>& paths);

/// values[order[0]], values[order[1]], ...
template <typename T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> out;
  out.reserve(values.size());
  for (const std::size_t i : order) out.push_back(values[i]);
  return out;
}

/// Makes the result for in_order(paths, order) one for `paths`: scans change places and numbers, pairs stay in their
/// order.
void restore_order(const std::vector<std::size_t>& order, PipelineResult& result);

}  // namespace tcm_icp
