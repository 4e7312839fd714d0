#pragma once
// Whether a scan is where it was put: one decision from everything that was measured.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tcm_icp/core/verdict.hpp"
#include "tcm_icp/registration/verification.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

/// What speaks for and against one scan's place in its component. Whoever measures does not judge.
struct ScanMeasurements {
  AlignmentEvidence evidence;    ///< of its held-out points against all scans it overlaps with, together
  FreeSpaceEvidence free_space;  ///< against the same scans
  double lead = 0;     ///< log-odds of its place by the hypotheses of pairs, against the best other place or none
  double support = 0;  ///< the same, against none
  std::optional<double> other_distance;  ///< [m] rms distance to that other place; none: nothing leads elsewhere
  std::size_t num_moved = 1;             ///< scans that would move with it
  /// Standard deviation of its points, rms, by the joint adjustment, in coarse voxels; none where that leaves it open.
  std::optional<double> sigma_in_voxels;
  /// Pairs that overlap across the weakest hold, at the final poses: those of the scan, or of the group that would move
  /// with it. What holds within the group says nothing of its place.
  std::size_t num_across = 0;
  FreeSpaceEvidence free_space_across;  ///< of these pairs

  /// What a pair across adds to the lead, 0 to 1000. Pairs that have next to nothing to say add up to a lead, too,
  /// where there are many of them.
  double lead_a_pair() const;
};

/// What scans of a component usually show.
struct ComponentReference {
  double inlier_share = 0;  ///< median
  double residual_m = 0;    ///< [m] lower median: of two scans the better counts
  double lead_a_pair = 0;   ///< median
  static ComponentReference of(const std::vector<ScanMeasurements>& members);
};

inline constexpr std::array<std::string_view, 16> kDecisionFeatureNames{
    "lead",         "log_lead",  "log_overlap",     "log_inlier_share", "inliers_by_set", "residual_by_set",
    "weakest_left", "mean_left", "left_across",     "across_unknown",   "violations",     "opposed",
    "few_agree",    "sigma",     "log_lead_a_pair", "lead_by_set"};
using DecisionFeatures = std::array<double, kDecisionFeatureNames.size()>;

/// Finite, without a unit, within bounds.
DecisionFeatures decision_features(const ScanMeasurements& m, const ComponentReference& component);

struct DecisionOptions {
  double confidence = kLeastConfidence;  ///< 0..1; least probability of a scan that counts as registered
  void validate() const;                 ///< throws InvalidOptions
};

struct Decision {
  Reason reason = Reason::kNotDecided;
  double probability = 0;       ///< that the place is right
  std::string text;             ///< the reason for a person, with its figures
  DecisionFeatures features{};  ///< what the probability was told from
  bool accepted() const { return reason == Reason::kAccepted || reason == Reason::kReference; }
};

/// Logistic model, fitted by scripts/calibrate.py to simulated sets (scan_model.inc). The reason is what took most from
/// the log-odds, compared with what right scans usually have.
Decision decide(const ScanMeasurements& measurements, const ComponentReference& component,
                const DecisionOptions& options);

}  // namespace tcm_icp
