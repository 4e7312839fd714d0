#pragma once
// Verification of a pose at a resolution.

#include "tcm_icp/registration/verification.hpp"

namespace tcm_icp {

/// Overlap within two voxels, agreement within a quarter of one, slides of four. All follow from the resolution, which
/// follows from what the data resolve.
inline VerificationOptions verification_at(double voxel_m) {
  VerificationOptions options;
  options.gate_m = 2 * voxel_m;
  options.tolerance_m = voxel_m / 4;
  options.slide_m = 4 * voxel_m;
  return options;
}

}  // namespace tcm_icp
