#pragma once
// What becomes of a scan, whether it can be trusted, and why not.

#include <string_view>

namespace tcm_icp {

/// Whether a scan has a pose in the common frame.
enum class ScanStatus {
  kReference,     ///< it defines the frame (or lies in the survey frame as the others do)
  kRegistered,    ///< it has a pose
  kUnregistered,  ///< it has none: nothing is guessed
};

/// Whether a pose can be trusted.
enum class Verdict {
  kAccepted,  ///< what was measured supports it
  kDoubtful,  ///< nothing confirms it, or not clearly
  kRejected,  ///< what was measured speaks against it
};

/// What decided about a scan; docs/flagged_scans.md says what to do about each.
enum class Reason {
  kNotDecided,    ///< nothing was decided: the paper's profile does not verify
  kReference,     ///< the reference scan
  kAccepted,      ///< its place reached the least probability
  kNoLink,        ///< nothing joins it to another scan
  kAmbiguous,     ///< another place fits about as well
  kMisfit,        ///< its points agree less, or less closely, than those of its set do
  kSlides,        ///< it can slide without losing agreement
  kSeenThrough,   ///< scans would have seen through walls
  kInexact,       ///< the joint adjustment leaves its pose too uncertain
  kTooFewPoints,  ///< too few points on surfaces to tell
};

/// Least probability of a scan that counts as registered, unless another is asked for.
inline constexpr double kLeastConfidence = 0.8;

/// "reference", "registered", "unregistered", as poses.json has it.
std::string_view to_string(ScanStatus status);

/// "accepted", "doubtful", "rejected", as poses.json has it.
std::string_view to_string(Verdict verdict);

/// A few words, as report.json has them: "ambiguous", "seen through walls".
std::string_view to_string(Reason reason);

}  // namespace tcm_icp
