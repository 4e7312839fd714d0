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
StepKey height_map_key(const PreparedScan& target, const PreparedScan& source, const std::vector<UpPair>& ups,
                       const HeightCorrelationOptions& options);
StepKey feature_key(const PreparedScan& target, const PreparedScan& source, const LinkSearchOptions& options);
StepKey slide_key(const PreparedScan& target, const PreparedScan& source, const std::vector<Eigen::Isometry3d>& from);
/// The grid of a set's height maps, by the digests of its scans; and the ranking of all its pairs, in their order.
StepKey grid_key(const std::vector<std::string>& scans, const HeightCorrelationOptions& options);
StepKey screening_key(const std::vector<std::string>& scans, const HeightCorrelationOptions& options);

/// Check sum over the options.
std::string search_digest(const LinkSearchOptions& options);

std::vector<std::string> digests_of(const std::vector<PreparedScan>& scans);

std::optional<std::vector<PoseCandidate>> find_candidates(const StepStore& store, const StepKey& key);
void save_candidates(const StepStore& store, const StepKey& key, const std::vector<PoseCandidate>& candidates,
                     double seconds);
std::vector<PoseCandidate> candidates_once(const StepStore& store, const StepKey& key,
                                           const std::function<std::vector<PoseCandidate>()>& search);

/// choose_correlation_grid() of a set; or that of the set with the digests `base`, where that one serves this one.
CorrelationGrid grid_once(const StepStore& store, const std::vector<PreparedScan>& scans,
                          const std::vector<std::string>& base, const HeightCorrelationOptions& options,
                          int num_threads);

/// screen_by_height_maps() of all pairs (a < b, a's first) of a set; those that `base` has and that were screened on
/// the same grid are not screened again. @param options  with a grid
std::vector<PairScreening> screenings_once(const StepStore& store, const std::vector<PreparedScan>& scans,
                                           const std::vector<std::string>& base,
                                           const HeightCorrelationOptions& options, int num_threads);

/// fit_candidate() of scans that have digests; without a store it is just that.
std::optional<LinkHypothesis> fit_candidate_once(const StepStore* store, const PreparedScan& target,
                                                 const PreparedScan& source, const PoseCandidate& candidate,
                                                 const LinkSearchOptions& options);

}  // namespace tcm_icp
