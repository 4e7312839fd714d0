#pragma once
// Inference over all hypotheses of a set.

namespace tcm_icp {

struct InferenceOptions {
  /// Logarithm of how many clearly different poses a pair has that a wrong hypothesis may be taken by: what agreement
  /// by chance is worth. Far fewer than fit into the search's space, since wrong hypotheses, too, lay walls on walls.
  double log_poses = 3;      ///< > 0
  double log_implied = 2;    ///< 0..log_poses; by how much less it says that a fit ends where it started from
  double log_missed = -1.5;  ///< <= 0; logarithm of how often a fit that starts at the right pose shows nothing
  /// <= 0; the same of a pair that was measured at poses as they were adjusted, without a fit of its own, where it sees
  /// what is free of surfaces: that is no matter of how near a fit got.
  double log_missed_there = -3;
  /// > 0; of an implied hypothesis, from which on that is so: what overlaps less shows less, right or wrong.
  double telling_overlap = 0.2;
  /// Of the agreement that a slide leaves: up to where a pair holds its pose, and from where on nothing holds it.
  double firm_left = 0.55;   ///< 0..1
  double loose_left = 0.85;  ///< > firm_left
  /// >= 0; of an implied hypothesis that nothing holds: by how much less it counts against poses that it is e times
  /// farther from. Fits slide away from right poses, too.
  double log_slid = 0.8;
  /// >= 0; logarithm of by how much rarer places are at which all pairs look as they do at the right one.
  double log_twins = 3;
  /// >= 0; by how much less the agreement of a pair says against them, where between the parts that its scans belong to
  /// clearly more is seen through than within them, either way, or pairs are clearly less likely; by nothing up to what
  /// right poses have (AlikeParts).
  /// As much as the surest pairs say of storeys that are alike: parts that look like twins hang by nothing.
  double log_alike = 6;
  double log_spread = 3;     ///< >= 0; by how much less it says of poses that it is e times farther from
  double most_log_odds = 8;  ///< > 0; of one hypothesis: no pair is surer
  /// >= 0; deviation, over sets, of a constant in the log-odds of all hypotheses of a set: what simulated sets have.
  double set_spread = 1;
  int max_starts = 24;  ///< >= 1; strongest hypotheses that configurations are grown from
  /// >= 1; scans that all starts together grow, so that cost stays linear in them: of large sets two starts at least
  /// are left, and moves reach what further ones would.
  int max_grown_scans = 300;
  int max_sweeps = 10;    ///< >= 1; of moves of single scans and of groups
  void validate() const;  ///< throws InvalidOptions
};

}  // namespace tcm_icp
