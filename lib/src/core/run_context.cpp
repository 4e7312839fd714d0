#include "tcm_icp/core/run_context.hpp"

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

void RunContext::report(std::string_view stage, std::size_t done, std::size_t total) const {
  if (on_progress && on_progress({stage, done, total}) == Continue::kStop) throw Cancelled();
}

}  // namespace tcm_icp
