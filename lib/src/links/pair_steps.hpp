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
/// The key of the ranking of all pairs of a set, in its order.
StepKey screening_key(const std::vector<PreparedScan>& scans, const HeightCorrelationOptions& options);

std::optional<std::vector<PoseCandidate>> find_candidates(const StepStore& store, const StepKey& key);
void save_candidates(const StepStore& store, const StepKey& key, const std::vector<PoseCandidate>& candidates,
                     double seconds);
std::vector<PoseCandidate> candidates_once(const StepStore& store, const StepKey& key,
                                           const std::function<std::vector<PoseCandidate>()>& search);
std::vector<PairScreening> screenings_once(const StepStore& store, const StepKey& key,
                                           const std::function<std::vector<PairScreening>()>& screen);

/// fit_candidate() of scans that have digests; without a store it is just that.
std::optional<LinkHypothesis> fit_candidate_once(const StepStore* store, const PreparedScan& target,
                                                 const PreparedScan& source, const PoseCandidate& candidate,
                                                 const LinkSearchOptions& options);

}  // namespace tcm_icp
