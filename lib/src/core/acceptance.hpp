#pragma once
// Every limit that lets a pose pass or not, in one place. What is a matter of degree is in the fitted models
// (links/link_model.inc, decision/scan_model.inc); the confidence asked for is an option (DecisionOptions).

#include <cstddef>

namespace tcm_icp {

// --- Hypotheses

/// [coarse voxels] Poses of a scan whose rms distance over its points is less are one: a fit starts from eight voxels
/// off and comes to the same optimum from half of that.
constexpr double kSameLinkPose = 4;
/// Log-odds of a hypothesis from which on the other candidates of its pair are not fitted. Of the simulated hypotheses
/// held out of the fit, 3 of 6,600 wrong ones were above.
constexpr double kClearLogOdds = 5;
/// Violations of free space before a fit, beyond which it is not worth it: right poses of real scenes, off by up to
/// four coarse voxels, came to 0.04 and less, those whose fits were wrong to 0.08 and more. A slide is right but for
/// two voxels or so, or wrong.
constexpr double kHopelessViolations = 0.12, kHopelessOfSlide = 0.04;
/// Share of a scan that overlaps within eight coarse voxels for a pair to be fitted from initial poses.
constexpr double kGuessedOverlap = 0.2;
/// Lead of a scan from which on no further pairs are compared for it: 400 to 1.
constexpr double kLeadToRest = 6;

// --- Links at the final poses

/// Share of a scan's points near another for the pair to be a link.
constexpr double kMinLinkOverlap = 0.1;
/// Probability from which on a link is accepted, and below which it is rejected; it sets no scan aside.
constexpr double kLinkAccepted = 0.95, kLinkRejected = 0.5;

// --- Scans

/// Agreeing points below which nothing is decided: a share of three in ten is known to 0.08 by so many.
constexpr std::size_t kFewAgreeing = 30;
/// [coarse voxels] Standard deviation of a scan's points up to which what is known of it in the survey frame puts it
/// there without a link to the others: poses so far apart are what a fit tells apart.
constexpr double kSureInSurvey = 1;

// --- Free space (docs/decisions/0017-scan-lines.md)

/// Beyond these shares, of so many points at least, a pose does not count as one of the fits a pair gets. Right poses
/// of real and simulated scenes stay below, wrong ones of interiors lie above.
constexpr double kMaxViolationShare = 0.0175, kVetoedOpposedShare = 0.3;
constexpr std::size_t kMinFreeSpacePoints = 100;  // at fewer, a share of three in a hundred is chance

}  // namespace tcm_icp
