#pragma once
// Which scan is merged next: the one most compatible with what is merged already.

#include <cstddef>
#include <span>

#include "tcm_icp/tcm/tcm.hpp"

namespace tcm_icp {

struct MergeCandidate {
  std::size_t scan = 0;  ///< position in the file list
  TcmTerms terms;        ///< against the merged cloud
};

/// True where `a` is merged before `b`: smaller tau; where tau is equal (0 for equal spacings), smaller f h, because f
/// is what still tells near from far; where that is equal too, file order.
bool merges_before(const MergeCandidate& a, const MergeCandidate& b);

/// The scan to merge next. Does not depend on the order of the candidates.
/// @throws InvalidInput  if there is no candidate, or a term is NaN
std::size_t next_scan_to_merge(std::span<const MergeCandidate> candidates);

}  // namespace tcm_icp
