#pragma once
// When evidence is enough.

#include <string>

#include "tcm_icp/registration/verification.hpp"

namespace tcm_icp {

/// Verification of a pose at resolution `voxel_m`: overlap within two voxels, agreement within a quarter of one, slides
/// of four. All follow from the resolution, which follows from the data.
VerificationOptions verification_at(double voxel_m);

struct Verdict {
  bool accepted = false;
  std::string reason;
};

Verdict judge(const AlignmentEvidence& evidence);

}  // namespace tcm_icp
