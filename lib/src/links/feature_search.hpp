#pragma once
// Poses of pairs by local features: scans are described once, when they are first asked for.

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "links/link_fit.hpp"
#include "links/pair_steps.hpp"
#include "links/search_depth.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/coarse/feature_alignment.hpp"
#include "tcm_icp/coarse/scan_words.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

class FeatureSearch {
 public:
  /// Keeps references: all must outlive the search.
  /// @param store  where searches are kept; nullptr: nowhere
  FeatureSearch(const std::vector<PreparedScan>& scans, const LinkSearchOptions& options, const RunContext& context,
                const StepStore* store);

  /// Of each pair.
  /// @param depth  kUsualDepth or kGreatDepth
  std::vector<std::vector<PoseCandidate>> candidates(const ScanPairs& pairs, int depth = kUsualDepth);

  /// How likely pairs overlap: scores of the best candidates by the first level alone, which tells that, too.
  std::vector<double> scores(const ScanPairs& pairs);

  /// How much each scan looks like this one (ScanWords::likeness).
  std::vector<double> likeness(std::size_t scan);

 private:
  using Alignments = std::map<ScanPairs::value_type, std::vector<PoseCandidate>>;
  using MakeKey = std::function<StepKey(const PreparedScan&, const PreparedScan&)>;

  void describe();
  void align(const ScanPairs& pairs, const FeatureAlignmentOptions& by, const MakeKey& key, Alignments& known);
  std::vector<PoseCandidate> aligned(std::size_t a, std::size_t b, const FeatureAlignmentOptions& by) const;

  const std::vector<PreparedScan>& scans_;
  const LinkSearchOptions& options_;
  const RunContext& context_;
  const StepStore* store_;
  FeatureAlignmentOptions by_all_levels_, by_first_level_;
  std::vector<DescribedScan> described_;
  std::optional<ScanWords> words_;
  std::map<int, Alignments> aligned_;  // by depth
  Alignments ranked_;                  // by the first level
};

}  // namespace tcm_icp
