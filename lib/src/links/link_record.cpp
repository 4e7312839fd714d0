#include "tcm_icp/links/link_record.hpp"

namespace tcm_icp {

std::string_view to_string(HypothesisStatus status) {
  switch (status) {
    case HypothesisStatus::kOpen:
      return "open";
    case HypothesisStatus::kConfirmed:
      return "confirmed";
    case HypothesisStatus::kContradicted:
      return "contradicted";
  }
  return "unknown";
}

}  // namespace tcm_icp
