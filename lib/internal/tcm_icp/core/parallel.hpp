#pragma once
// Parallel loops whose result does not depend on the number of threads: each index writes its own slot.

#include <cstddef>
#include <functional>

namespace tcm_icp {

/// Calls body(begin, end) on disjoint ranges that cover [0, count), on up to `num_threads` threads. The body must write
/// only to slots of its own range; whatever is summed up is summed afterwards in index order. An exception of the body
/// is rethrown.
void parallel_for(int num_threads, std::size_t count, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace tcm_icp
