#pragma once
// Poses of pairs by their height maps: screened for the ways to be up, searched, and kept where there is a work folder.

#include <map>
#include <string>
#include <vector>

#include "links/search_depth.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/coarse/height_correlation.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// What was searched and fitted before, for scans that have digests.
struct KeptSearches {
  const StepStore* store = nullptr;  ///< nullptr: nothing is kept
  /// Digests of the scans, in their order, of a set whose scans are among these: what was found of its pairs holds.
  std::vector<std::string> base;
};

/// Of a pair's maps: those of the set, so that it makes no difference which pairs are looked at together.
struct HeightMapGrids {
  CorrelationGrid screening, full;
};

class HeightMapSearch {
 public:
  /// Keeps references: all must outlive the search.
  HeightMapSearch(const std::vector<PreparedScan>& scans, bool levelled, const RunContext& context,
                  const KeptSearches& kept);

  /// Of each pair. Cost: that of finding what is up in every scan, once.
  std::vector<HeightMapGrids> grids_of(const ScanPairs& pairs);

  /// Of each pair, on the grids of this set.
  /// @param depth  kUsualDepth or kGreatDepth
  std::vector<std::vector<PoseCandidate>> candidates(const ScanPairs& pairs, int depth = kUsualDepth);

  /// The same on the grids of a larger set: those that are kept there; of the others a block at a time is searched and
  /// kept.
  /// @param grids  of each pair
  std::vector<std::vector<PoseCandidate>> candidates_on(const std::vector<HeightMapGrids>& grids,
                                                        const ScanPairs& pairs, int depth = kUsualDepth);

  /// How likely pairs overlap, by coarse maps (PairScreening::score).
  std::vector<double> scores(const ScanPairs& pairs);

 private:
  std::vector<std::vector<PoseCandidate>> search(const ScanPairs& pairs, const HeightMapGrids& grids, int depth);
  void screen(const ScanPairs& pairs, const CorrelationGrid& grid);

  const std::vector<PreparedScan>& scans_;
  ScansFromAbove from_above_;
  const RunContext& context_;
  const KeptSearches& kept_;
  std::vector<HeightMapGrids> of_scans_;                     // once they are asked for
  std::map<ScanPairs::value_type, PairScreening> screened_;  // the same
  // The same, on the set's own grids, by depth.
  std::map<int, std::map<ScanPairs::value_type, std::vector<PoseCandidate>>> found_;
};

}  // namespace tcm_icp
