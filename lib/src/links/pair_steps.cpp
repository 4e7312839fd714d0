#include "links/pair_steps.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "steps/do_once.hpp"
#include "steps/key_parts.hpp"

namespace tcm_icp {

// Each field by name, so that a field more does not compile before it is listed here.

template <typename Record, MaybeConst<PoseCandidate> T>
void transfer(Record& record, T& value) {
  auto& [T_target_source, method, score, margin, there, accuracy_m] = value;
  record(T_target_source, method, score, margin, there, accuracy_m);
}

template <typename Record, MaybeConst<AlignmentEvidence> T>
void transfer(Record& record, T& value) {
  auto& [num_points, overlap, inlier_share, residual_m, tolerance_m, left, slide_m, left_across, num_across] = value;
  record(num_points, overlap, inlier_share, residual_m, tolerance_m, left, slide_m, left_across, num_across);
}

template <typename Record, MaybeConst<FreeSpaceEvidence> T>
void transfer(Record& record, T& value) {
  auto& [num_points, num_violating, num_matches, num_opposed, num_points_of_b, num_violating_of_b, num_large,
         num_large_of_b] = value;
  record(num_points, num_violating, num_matches, num_opposed, num_points_of_b, num_violating_of_b, num_large,
         num_large_of_b);
}

template <typename Record, MaybeConst<LinkMeasurements> T>
void transfer(Record& record, T& value) {
  auto& [evidence, other_overlap, other_inlier_share, free_space, slid_space, sighted] = value;
  record(evidence, other_overlap, other_inlier_share, free_space, slid_space, sighted);
}

template <typename Record, MaybeConst<VerticalOptions> T>
void transfer(Record& record, T& value) {
  auto& [levelled, max_axes, min_area_ratio, max_roughness_ratio] = value;
  record(levelled, max_axes, min_area_ratio, max_roughness_ratio);
}

template <typename Record, MaybeConst<HeightMapOptions> T>
void transfer(Record& record, T& value) {
  auto& [smoothing_cells, clip_sigma] = value;
  record(smoothing_cells, clip_sigma);
}

template <typename Record, MaybeConst<CorrelationGrid> T>
void transfer(Record& record, T& value) {
  auto& [cell_m, size] = value;
  record(cell_m, size);
}

template <typename Record, MaybeConst<HeightCorrelationOptions> T>
void transfer(Record& record, T& value) {
  auto& [cells_across, max_grid, heading_step_deg, min_shared_share, max_candidates, depth, map, grid] = value;
  record(cells_across, max_grid, heading_step_deg, min_shared_share, max_candidates, depth, map, grid);
}

namespace {

// Cells are about as large: scores count them.
constexpr double kMostOff = 1.1;

bool are_alike(const CorrelationGrid& a, const CorrelationGrid& b) {
  return a.cell_m <= kMostOff * b.cell_m && b.cell_m <= kMostOff * a.cell_m;
}

double width_m(const CorrelationGrid& grid) { return grid.cell_m * grid.size; }

/// What a fit adds to the candidate it starts from.
struct Fit {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  LinkMeasurements measurements;
};

template <typename Record, MaybeConst<Fit> T>
void transfer(Record& record, T& value) {
  auto& [T_a_b, measurements] = value;
  record(T_a_b, measurements);
}

}  // namespace

StepKey height_map_key(const PreparedScan& target, const PreparedScan& source, const VerticalOptions& vertical,
                       const HeightCorrelationOptions& screening, const HeightCorrelationOptions& full) {
  return step_key("height-maps", target.digest, source.digest, vertical, screening, full);
}

StepKey ranking_key(const PreparedScan& target, const PreparedScan& source, const LinkSearchOptions& options) {
  return step_key("rankings", target.digest, source.digest, options.level);
}

StepKey feature_key(const PreparedScan& target, const PreparedScan& source, const LinkSearchOptions& options,
                    int depth) {
  return step_key("features", target.digest, source.digest, options.level, depth);
}

StepKey slide_key(const PreparedScan& target, const PreparedScan& source, const std::vector<Eigen::Isometry3d>& from) {
  return step_key("slides", target.digest, source.digest, from);
}

std::string search_digest(const LinkSearchOptions& options) {
  const auto& [formulation, lp, level, features, slides] = options;
  return step_key("searches", formulation, lp, level, features, slides).digest;
}

std::vector<std::string> digests_of(const std::vector<PreparedScan>& scans) {
  std::vector<std::string> out;
  for (const auto& scan : scans) out.push_back(scan.digest);
  return out;
}

std::optional<std::vector<PoseCandidate>> find_candidates(const StepStore& store, const StepKey& key) {
  return find_step<std::vector<PoseCandidate>>(store, key);
}

void save_candidates(const StepStore& store, const StepKey& key, const std::vector<PoseCandidate>& candidates,
                     double seconds) {
  save_step(store, key, candidates, seconds);
}

std::vector<PoseCandidate> candidates_once(const StepStore* store, const std::function<StepKey()>& key,
                                           const std::function<std::vector<PoseCandidate>()>& search) {
  return store != nullptr ? do_once<std::vector<PoseCandidate>>(*store, key(), search) : search();
}

const CorrelationGrid& grid_of_pair(const CorrelationGrid& a, const CorrelationGrid& b) {
  return width_m(a) != width_m(b) ? (width_m(a) > width_m(b) ? a : b) : (a.cell_m >= b.cell_m ? a : b);
}

std::vector<CorrelationGrid> grids_once(const StepStore& store, const std::vector<std::string>& digests,
                                        const std::vector<std::string>& base, ScansFromAbove& scans,
                                        const HeightCorrelationOptions& options, int num_threads) {
  using Grids = std::vector<CorrelationGrid>;
  const auto key = [&](const std::vector<std::string>& set) {
    return step_key("grids", set, scans.vertical(), options);
  };
  return do_once<Grids>(store, key(digests), [&] {
    const CorrelationGrid own = choose_correlation_grid(scans, options, num_threads);
    const auto kept = base.empty() ? std::nullopt : find_step<Grids>(store, key(base));
    if (!kept || kept->size() != base.size() ||
        !std::all_of(kept->begin(), kept->end(), [&](const CorrelationGrid& g) { return are_alike(g, own); })) {
      return Grids(scans.size(), own);
    }
    CorrelationGrid next = kept->front();
    std::unordered_map<std::string, CorrelationGrid> grid_of;
    for (std::size_t i = 0; i < base.size(); ++i) {
      grid_of[base[i]] = (*kept)[i];
      next = grid_of_pair(next, (*kept)[i]);
    }
    if (width_m(next) < width_m(own)) next = own;
    Grids out;
    for (const auto& digest : digests) out.push_back(grid_of.contains(digest) ? grid_of[digest] : next);
    return out;
  });
}

std::optional<LinkHypothesis> fit_candidate_once(const StepStore* store, const PreparedScan& target,
                                                 const PreparedScan& source, const PoseCandidate& candidate,
                                                 const LinkSearchOptions& options) {
  if (store == nullptr) return fit_candidate(target, source, candidate, options);
  const auto& [formulation, lp, level, features, slides] = options;
  const StepKey key =
      step_key("fits", target.digest, source.digest, candidate.T_target_source,
               candidate.method == CoarseMethod::kSlide, candidate.there, candidate.accuracy_m, formulation, lp);
  const auto fit = do_once<std::optional<Fit>>(*store, key, [&]() -> std::optional<Fit> {
    const auto found = fit_candidate(target, source, candidate, options);
    if (!found) return std::nullopt;
    return Fit{found->T_a_b, found->measurements};
  });
  if (!fit) return std::nullopt;
  return LinkHypothesis{fit->T_a_b, candidate, fit->measurements};
}

}  // namespace tcm_icp
