#pragma once
// Pairs of scans in the result: links at the final poses, and the hypotheses they were found among.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/core/verdict.hpp"
#include "tcm_icp/links/link_measurements.hpp"
#include "tcm_icp/links/link_residuals.hpp"
#include "tcm_icp/registration/link_strength.hpp"

namespace tcm_icp {

/// Two scans whose points overlap at the final poses.
struct LinkRecord {
  std::size_t a = 0, b = 0;    ///< by their places in the list
  AlignmentEvidence evidence;  ///< of the direction that overlaps more
  FreeSpaceEvidence free_space;
  double probability = 0;  ///< that the pose is right, by the pair alone
  Verdict verdict = Verdict::kRejected;
  std::string reason;                    ///< for a person
  std::optional<LinkStrength> strength;  ///< in the reference's local frame; robust profile only
  LinkResiduals residuals = {};          ///< at the resolution scans were adjusted with; robust profile only
};

/// What the final poses say of a pose that a pair may have.
enum class HypothesisStatus {
  kOpen,          ///< nothing: no group has both scans
  kConfirmed,     ///< they have it
  kContradicted,  ///< they have another
};

/// "open", "confirmed", "contradicted": `fate` in report.json.
std::string_view to_string(HypothesisStatus status);

/// A pose that a pair may have, found without a guess, and what became of it.
struct LinkHypothesisRecord {
  std::size_t a = 0, b = 0;                                 ///< by their places in the list
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();  ///< for raw coordinates
  PoseCandidate candidate;                                  ///< the coarse pose it came from, for raw coordinates
  AlignmentEvidence evidence;                               ///< of the pair alone
  FreeSpaceEvidence free_space;
  bool is_later = false;    ///< found for a scan that the first search left without a clear place
  double log_odds = 0;      ///< that it is right, by the pair alone and what is known of the survey frame
  double by_survey = 0;     ///< the latter's part, at most 0
  LinkFeatures features{};  ///< what that was told from
  HypothesisStatus status = HypothesisStatus::kOpen;
};

}  // namespace tcm_icp
