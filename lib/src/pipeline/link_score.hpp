#pragma once
// How likely one link is right, from the evidence of the pair alone.

#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/registration/verification.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

/// Logarithm of the odds that a pose is right: a logistic model of how much overlaps, how much of that agrees and how
/// closely, how much is lost when the pose slides, and how far the coarse pose stood out from others
/// (docs/decisions/0011-link-score.md says what it was fitted to, and how it did elsewhere). 0 is a coin toss. Finite.
double link_log_odds(const AlignmentEvidence& evidence, const PoseCandidate& candidate, double voxel_m);

/// What a hypothesis loses to a rival of its pair, a clearly different pose with more consensus: 0 or less. Rivals are
/// looked at by the same points, so their consensus tells them apart better than where they came from.
double rival_log_odds(double consensus, double rival_consensus);

/// What a hypothesis loses to violations of free space that are too few for a veto: 0 or less. Right poses of real and
/// simulated scenes have 0.002 of them and, nine of ten, at most 0.006; wrong ones that nothing else tells from right
/// have 0.007 and more, nine of ten (decision 0018).
double free_space_log_odds(const FreeSpaceEvidence& free_space);

/// Free space that speaks against a pose by no more bears it out, where enough points tell.
constexpr double kBorneOut = -1;

/// What a placed scan loses where it fits worse than its set does: 0 up to twice the typical median residual, then four
/// times the logarithm. Scans of one set lie within 1.9 times of it where they are right; a mirrored building that no
/// other evidence told from the real one had 4.8 times.
double misfit_log_odds(double residual_m, double typical_residual_m);

/// What a hypothesis has at the most where free space vetoes it: no pose to start from, whatever else speaks for it.
constexpr double kVetoedLogOdds = -6;

/// Links above this stand by themselves.
constexpr double kClearLogOdds = 3;

/// Links speak against a pose by what they exceed this: chance alone often makes a pose that looks a little likely.
constexpr double kDoubtLogOdds = 1;

}  // namespace tcm_icp
