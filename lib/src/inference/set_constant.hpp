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

/// A constant to be added to the log-odds of all of them: the mode of its posterior, where sets differ by a normal
/// distribution with deviation `spread` about 0 (a random intercept; what scripts/calibrate.py fits the model with). No
/// model knows each sensor and scene; that all pairs of a corridor look poor alike says nothing against any of them.
/// 0 where `spread` is 0 or nothing is judged. Cost: linear.
double set_constant(const std::vector<JudgedHypothesis>& judged, double spread);

/// What hypotheses' own log-odds are to be multiplied by, and what is to be added then.
struct SetShift {
  double constant = 0;
  double slope = 1;
  double of(double log_odds) const { return constant + slope * log_odds; }
};

/// The same with a slope, normally distributed with deviation `spread` about 1. Where thousands of pairs are compared
/// that share nothing, most of what looks half right is wrong, and what looks right is right: a constant alone would
/// be taught by the many, and take from the few.
SetShift set_shift(const std::vector<JudgedHypothesis>& judged, double spread);

}  // namespace tcm_icp
