#pragma once
// Links of a pair as a search would have found them, made from the truth.

#include "pipeline/link_search.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp::testing {

/// A hypothesis off the truth by `angle_rad` and `shift_m`, with odds as given.
inline LinkHypothesis link_hypothesis(const SyntheticScene& scene, std::size_t a, std::size_t b, double log_odds,
                                      double angle_rad, double shift_m, Rng& rng) {
  LinkHypothesis h;
  h.T_a_b = perturbed(scene.T_target_source(a, b), scene.scans[b].points, angle_rad, shift_m, rng);
  h.log_odds = log_odds;
  return h;
}

}  // namespace tcm_icp::testing
