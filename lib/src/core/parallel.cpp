#include "tcm_icp/core/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace tcm_icp {

void parallel_for(int num_threads, std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  if (num_threads <= 1) {
    body(0, count);
    return;
  }
  // More threads than processors gain nothing, and TBB would say so on stderr.
  tbb::task_arena arena(std::min(num_threads, tbb::info::default_concurrency()));
  const std::size_t grain = std::max<std::size_t>(1, count / (8 * static_cast<std::size_t>(num_threads)));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
  });
}

}  // namespace tcm_icp
