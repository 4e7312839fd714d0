#include "inference/alike_parts.hpp"

#include <algorithm>

namespace tcm_icp {

AlikeParts::AlikeParts(const PairGraph& graph, const Component& component)
    : seen_through_(graph, component), less_likely_(graph, component), log_alike_(graph.options().log_alike) {}

double AlikeParts::less_said(std::size_t a, std::size_t b) const {
  return log_alike_ * std::max(seen_through_.twins(a, b), less_likely_.twins(a, b));
}

std::vector<std::vector<std::size_t>> AlikeParts::parts() const {
  auto out = seen_through_.parts();
  const auto more = less_likely_.parts();
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

}  // namespace tcm_icp
