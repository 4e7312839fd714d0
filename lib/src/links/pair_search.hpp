#pragma once
// Which pairs of scans to try for links, and in which order; the coarse aligners behind it.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "inference/implied_poses.hpp"
#include "links/height_map_search.hpp"
#include "links/hypotheses.hpp"
#include "links/link_fit.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/coarse/height_correlation.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// The pairs that every search begins with, each of which can be searched by itself.
struct FirstPairs {
  ScanPairs pairs;
  std::vector<HeightMapGrids> grids;  ///< of each pair
};

class PairSearch {
 public:
  /// Keeps references: all must outlive the search.
  PairSearch(const std::vector<PreparedScan>& scans, const LinkSearchOptions& options, const RunContext& context,
             KeptSearches kept = {});
  ~PairSearch();

  /// What extend() tries first where all scans are wanted.
  FirstPairs first_pairs();

  /// Does the steps of pairs that first_pairs() of a larger set gave, and keeps them: each is searched, and its most
  /// promising candidate fitted. @pre there is a store
  void match(const FirstPairs& first);

  /// Whether two scans can overlap at all at a pose, as far as their extents tell.
  bool may_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const;

  /// Fits pairs from poses that others of their scans lead to, where they overlap there and were not tried before. True
  /// where any was fitted.
  bool try_implied(const std::vector<ImpliedPose>& poses, HypothesisSet& set);

  /// Fits the pairs of scans with initial poses from those, where they overlap there.
  void try_guesses(const std::vector<std::optional<Eigen::Isometry3d>>& T_common_scan, HypothesisSet& set);

  /// Tries the pairs of `wanted` scans with those of other `groups` (numbers by scan: poses within a group are clear)
  /// by the next method that they were not tried by: height maps, features, slides of the poses that those fitted to
  /// (slide_search.hpp); where a few scans of a large set are wanted, by all three. Hypotheses go to the set. False
  /// where no pair was left. Each scan is tried with the six others that look most like it (ScanWords); once they were
  /// tried by all methods, wanted scans are tried with twice as many. Cost: some 50 ms of processor time a pair and
  /// method, and a scan.
  bool extend(const std::vector<bool>& wanted, const std::vector<std::size_t>& groups, HypothesisSet& set);

  /// How many scans try_between() can be asked for with no more pairs than first partners are; 0 in small sets, where
  /// every pair may be tried in the end.
  std::size_t most_between() const;

  /// Tries pairs of these scans that lie between groups by all methods: each scan with the six that its height map is
  /// most like and the six whose features align best. Hypotheses go to the set. False where no pair was left. Cost:
  /// height maps and features of all those pairs, and extend()'s for the ones that are tried.
  bool try_between(const std::vector<std::size_t>& some, const std::vector<std::size_t>& groups, HypothesisSet& set);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
