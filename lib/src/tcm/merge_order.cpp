#include "tcm_icp/tcm/merge_order.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

bool merges_before(const MergeCandidate& a, const MergeCandidate& b) {
  if (a.terms.tau() != b.terms.tau()) return a.terms.tau() < b.terms.tau();
  const double fh_a = a.terms.f * a.terms.h;
  const double fh_b = b.terms.f * b.terms.h;
  return fh_a != fh_b ? fh_a < fh_b : a.scan < b.scan;
}

std::size_t next_scan_to_merge(std::span<const MergeCandidate> candidates) {
  if (candidates.empty()) throw InvalidInput("no scan is left to merge");
  for (const auto& c : candidates) {
    if (std::isnan(c.terms.tau()) || std::isnan(c.terms.f * c.terms.h)) {
      throw InvalidInput("the compatibility of scan " + std::to_string(c.scan) + " is not a number");
    }
  }
  return std::min_element(candidates.begin(), candidates.end(), merges_before)->scan;
}

}  // namespace tcm_icp
