#pragma once
// A set of hypotheses that has none yet.

#include <vector>

#include "links/hypotheses.hpp"
#include "pipeline/prepared_scene.hpp"

namespace tcm_icp::testing {

inline HypothesisSet no_hypotheses(const PreparedScene& s) {
  std::vector<PointMoments> moments;
  for (const auto& scan : s.scans) moments.push_back(scan.moments);
  return {s.resolutions.coarse_m, 0.01, std::move(moments)};
}

}  // namespace tcm_icp::testing
