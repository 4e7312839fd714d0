#pragma once
// When evidence is enough.

#include <string>

#include "tcm_icp/registration/verification.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

/// Least log-odds of a pose by its links, where it was found without a guess: 20 to 1, before what S says of it.
constexpr double kMinLinkLogOdds = 3;

/// Verification of a pose at resolution `voxel_m`: overlap within two voxels, agreement within a quarter of one, slides
/// of four. All follow from the resolution, which follows from the data.
VerificationOptions verification_at(double voxel_m);

struct Verdict {
  bool accepted = false;
  std::string reason;
};

/// What is left of the agreement after a slide by four voxels, at most, where a pose is right. On real and simulated
/// scenes right poses leave 0.16 to 0.70 in their weakest direction, wrong ones 0.79 and more, most of them above 1.
constexpr double kMaxLeftAfterSlide = 0.75;

/// Whether what lies across the weakest direction holds a pose by itself: along a corridor most of a scan agrees
/// wherever it slides to.
bool may_be_held_across(const AlignmentEvidence& evidence);

/// Whether it does, and free space bears it out.
bool held_across(const AlignmentEvidence& evidence, const FreeSpaceEvidence& free_space);

/// @param free_space  of the same pose, where it was looked at
Verdict judge(const AlignmentEvidence& evidence, const FreeSpaceEvidence& free_space = {});

}  // namespace tcm_icp
