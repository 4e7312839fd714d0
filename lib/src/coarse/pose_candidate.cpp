#include "tcm_icp/coarse/pose_candidate.hpp"

namespace tcm_icp {

std::string_view to_string(CoarseMethod method) {
  switch (method) {
    case CoarseMethod::kFeatures:
      return "features";
    case CoarseMethod::kHeightMap:
      return "height map";
    case CoarseMethod::kSlide:
      return "slide";
    case CoarseMethod::kGuess:
      return "initial pose";
    case CoarseMethod::kImplied:
      return "other links";
  }
  return "unknown";
}

}  // namespace tcm_icp
