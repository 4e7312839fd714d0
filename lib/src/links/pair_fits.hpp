#pragma once
// Candidates of many pairs, fitted until each pair has a clear hypothesis or has had its tries.

#include <cstddef>
#include <map>
#include <vector>

#include "links/hypotheses.hpp"
#include "links/link_fit.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

class PairFits {
 public:
  /// Keeps references: all must outlive this.
  /// @param store  where fits are kept; nullptr: nowhere
  PairFits(const std::vector<PreparedScan>& scans, const LinkSearchOptions& options, const RunContext& context,
           const StepStore* store);

  /// The most promising candidate of every pair, then the next of pairs that have no clear hypothesis yet: what the set
  /// shows by then tells which have one. Hypotheses go to the set.
  /// @param candidates  of each pair
  /// @param stage       of the candidates; of deep ones only hypotheses that are likelier right than wrong are left
  void fit(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates, SearchStage stage,
           HypothesisSet& set);

  /// The most promising candidates of each pair until one is fitted, which the store keeps.
  void fit_first(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates) const;

  /// Candidates of a pair that lie farther than `distance_m` from all that were looked at before.
  std::vector<PoseCandidate> untried(std::size_t a, std::size_t b, std::vector<PoseCandidate> candidates,
                                     double distance_m) const;

  /// T_a_b of all fits of a pair so far.
  const std::vector<Eigen::Isometry3d>& poses_of(std::size_t a, std::size_t b) const;

 private:
  const std::vector<PreparedScan>& scans_;
  const LinkSearchOptions& options_;
  const RunContext& context_;
  const StepStore* store_;
  using Poses = std::map<ScanPairs::value_type, std::vector<Eigen::Isometry3d>>;
  Poses tried_, fitted_;  // candidates, fitted or hopeless; and where fits ended
};

}  // namespace tcm_icp
