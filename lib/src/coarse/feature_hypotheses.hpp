#pragma once
// The poses of a pair that its features suggest, with all that is known about each.

#include <vector>

#include "tcm_icp/coarse/feature_alignment.hpp"

namespace tcm_icp {

struct FeatureHypothesis {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  std::size_t level = 0;      ///< position in the options' levels
  std::vector<double> votes;  ///< by matches of each level
  double overlap = 0;         ///< share of the samples that is near the other scan
  double agreement = 0;       ///< share of those whose distance along the normal, and normal, agree

  double total_votes() const;
  double score() const;
};

/// By score, best first; clearly different from one another.
std::vector<FeatureHypothesis> feature_hypotheses(const FeatureView& target, const FeatureView& source,
                                                  const FeatureAlignmentOptions& options);

}  // namespace tcm_icp
