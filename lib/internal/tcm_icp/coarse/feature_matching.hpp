#pragma once
// Pairs of keypoints that look alike.

#include <cstdint>
#include <vector>

#include "tcm_icp/coarse/fpfh.hpp"

namespace tcm_icp {

struct FeatureMatch {
  std::uint32_t target = 0, source = 0;  ///< columns of the descriptors
  float similarity = 0;                  ///< dot product of the descriptors, at most 1
};

/// Each column's most similar column of the other scan, in both directions: one way is enough to match, because where
/// little is shared few nearest neighbours are mutual, and the consensus stands wrong matches well. Exhaustive; of
/// equally similar columns the one with the lowest index counts. First the source's, then what the target's add.
/// @param target, source  unit columns
/// O(N M).
std::vector<FeatureMatch> match_features(const Descriptors& target, const Descriptors& source);

}  // namespace tcm_icp
