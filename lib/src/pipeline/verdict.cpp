#include "verdict.hpp"

#include <cstdio>

namespace tcm_icp {

VerificationOptions verification_at(double voxel_m) {
  VerificationOptions options;
  options.gate_m = 2 * voxel_m;
  options.tolerance_m = voxel_m / 4;
  options.slide_m = 4 * voxel_m;
  return options;
}

Verdict judge(const AlignmentEvidence& evidence) {
  return {evidence.num_points > 0, "not judged"};
}

}  // namespace tcm_icp
