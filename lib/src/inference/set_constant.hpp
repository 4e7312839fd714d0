#pragma once
// How much likelier the hypotheses of one set are than those of other sets that look alike.

#include <vector>

namespace tcm_icp {

/// A hypothesis of which the set's poses say whether it is right.
struct JudgedHypothesis {
  double log_odds = 0;  ///< by itself
  bool right = false;
  double sure = 1;  ///< 0..1; probability that those poses are right
};

/// What hypotheses' own log-odds are to be multiplied by, and what is to be added then.
struct SetShift {
  double constant = 0;
  double slope = 1;
  double of(double log_odds) const { return constant + slope * log_odds; }
};

/// The mode of the posterior, where sets differ by normal distributions: in the constant with deviation `spread` about
/// 0, in the slope with `slope_spread` about 1 (random effects; what scripts/calibrate.py fits the model with). No
/// model knows each sensor and scene; that all pairs of a corridor look poor alike says nothing against any of them.
/// And where thousands of pairs are compared that share nothing, most of what looks half right is wrong, and what looks
/// right is right: a constant alone would be taught by the many, and take from the few. Nothing changes where `spread`
/// is 0 or nothing is judged; the slope is 1 where its spread is 0. Cost: linear.
SetShift set_shift(const std::vector<JudgedHypothesis>& judged, double spread, double slope_spread);

/// The constant of one without a slope.
double set_constant(const std::vector<JudgedHypothesis>& judged, double spread);

}  // namespace tcm_icp
