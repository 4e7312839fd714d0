#pragma once
// What a pair of scans shows at one pose, and the same as numbers that mean one thing on every sensor.

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/registration/verification.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {

struct LinkMeasurements {
  AlignmentEvidence evidence;     ///< of the direction that overlaps more
  double other_overlap = 0;       ///< of the other direction
  double other_inlier_share = 0;  ///< of the other direction
  FreeSpaceEvidence free_space;   ///< both directions together
  FreeSpaceEvidence slid_space;   ///< slid along what holds the pair least, the way that less is seen through; no sides
  bool sighted = false;           ///< both scans see space: free space that tells nothing means that they share none
};

/// What the search for the pose says of it.
struct SearchMeasurements {
  CoarseMethod method = CoarseMethod::kFeatures;
  double margin = 1;             ///< PoseCandidate::margin
  double second_best_ratio = 0;  ///< consensus of the pair's best clearly different pose, by this one's
};

/// What measurements are compared with: the set's own scans and its better hypotheses.
struct SetReference {
  double voxel_m = 0;             ///< [m] coarse voxel
  double noise_m = 0;             ///< [m] median deviation from a local plane
  double best_inlier_share = 1;   ///< 0.95 quantile over the hypotheses
  double typical_residual_m = 0;  ///< [m] median residual of the tenth of them with the most consensus
  double constant = 0;            ///< added to the log-odds of all of the set's poses: HypothesisSet::learn_constants()
  /// In its place, of poses that were found for scans which the first search left; their log-odds have a factor, too.
  double later_constant = 0, later_slope = 1;

  /// @param hypotheses  of a whole set, right and wrong ones
  static SetReference of(double voxel_m, double noise_m, const std::vector<LinkMeasurements>& hypotheses);
};

/// Names of the numbers below, in their order.
inline constexpr std::array<std::string_view, 24> kLinkFeatureNames{"log_overlap",
                                                                    "log_other_overlap",
                                                                    "log_inlier_share",
                                                                    "log_other_inlier_share",
                                                                    "inliers_by_best",
                                                                    "residual_by_voxel",
                                                                    "residual_by_typical",
                                                                    "voxel_by_noise",
                                                                    "weakest_left",
                                                                    "mean_left",
                                                                    "left_across",
                                                                    "across_unknown",
                                                                    "violations",
                                                                    "opposed",
                                                                    "space_unseen",
                                                                    "held_by_space",
                                                                    "held_unknown",
                                                                    "blind",
                                                                    "second_best",
                                                                    "height_map_margin",
                                                                    "height_map",
                                                                    "feature_margin",
                                                                    "slide",
                                                                    "implied"};
inline constexpr std::size_t kBlind = 17;            ///< place of "blind": neither model judges what the other does
inline constexpr std::size_t kNumPoseFeatures = 18;  ///< the others are of the search
using LinkFeatures = std::array<double, kLinkFeatureNames.size()>;

/// Finite, without a unit, each within bounds beyond which it says no more. Search features are 0 without a search.
LinkFeatures link_features(const LinkMeasurements& measurements, const std::optional<SearchMeasurements>& search,
                           const SetReference& set);

}  // namespace tcm_icp
