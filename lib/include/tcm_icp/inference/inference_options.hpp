#pragma once
// Inference over all hypotheses of a set.

namespace tcm_icp {

struct InferenceOptions {
  /// Logarithm of how many clearly different poses a pair has that a wrong hypothesis may be taken by: what agreement
  /// by chance is worth. Far fewer than fit into the search's space, since wrong hypotheses, too, lay walls on walls.
  double log_poses = 3;      ///< > 0
  double most_log_odds = 8;  ///< > 0; of one hypothesis: no pair is surer
  int max_starts = 24;       ///< >= 1; strongest hypotheses that configurations are grown from
  int max_sweeps = 10;       ///< >= 1; of moves of single scans and of groups
  void validate() const;     ///< throws InvalidOptions
};

}  // namespace tcm_icp
