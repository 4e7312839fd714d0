#pragma once
// The steps of pairs of scans, with a work folder: taken from there where they are, else done and kept.

#include <functional>
#include <optional>
#include <vector>

#include "links/hypotheses.hpp"
#include "links/link_fit.hpp"
#include "scans/prepared_scan.hpp"
#include "steps/step_key.hpp"
#include "tcm_icp/coarse/height_correlation.hpp"
#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// The key of a pair's search by height maps.
StepKey height_map_key(const PreparedScan& target, const PreparedScan& source, const VerticalOptions& vertical,
                       const HeightCorrelationOptions& screening, const HeightCorrelationOptions& full);
/// Of the alignment that ranks a scan's partners.
StepKey ranking_key(const PreparedScan& target, const PreparedScan& source, const LinkSearchOptions& options);
/// @param depth  kUsualDepth or kGreatDepth
StepKey feature_key(const PreparedScan& target, const PreparedScan& source, const LinkSearchOptions& options,
                    int depth);
StepKey slide_key(const PreparedScan& target, const PreparedScan& source, const std::vector<Eigen::Isometry3d>& from);
/// Check sum over the options.
std::string search_digest(const LinkSearchOptions& options);

std::vector<std::string> digests_of(const std::vector<PreparedScan>& scans);

std::optional<std::vector<PoseCandidate>> find_candidates(const StepStore& store, const StepKey& key);
void save_candidates(const StepStore& store, const StepKey& key, const std::vector<PoseCandidate>& candidates,
                     double seconds);
/// A search that is kept; without a store it is just that, and needs no key.
std::vector<PoseCandidate> candidates_once(const StepStore* store, const std::function<StepKey()>& key,
                                           const std::function<std::vector<PoseCandidate>()>& search);

/// For each scan of a set the grid that it is compared on with those that came no later: choose_correlation_grid() of
/// the set; for scans of the set with the digests `base` what they had there, as long as cells are about as large.
/// @param digests  of the scans
std::vector<CorrelationGrid> grids_once(const StepStore& store, const std::vector<std::string>& digests,
                                        const std::vector<std::string>& base, ScansFromAbove& scans,
                                        const HeightCorrelationOptions& options, int num_threads);

/// That of the scan that came later: it holds both.
const CorrelationGrid& grid_of_pair(const CorrelationGrid& a, const CorrelationGrid& b);

/// fit_candidate() of scans that have digests; without a store it is just that.
std::optional<LinkHypothesis> fit_candidate_once(const StepStore* store, const PreparedScan& target,
                                                 const PreparedScan& source, const PoseCandidate& candidate,
                                                 const LinkSearchOptions& options);

}  // namespace tcm_icp
