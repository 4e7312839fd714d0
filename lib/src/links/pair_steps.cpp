#include "links/pair_steps.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "steps/do_once.hpp"
#include "steps/key_parts.hpp"

namespace tcm_icp {

// Each field by name, so that a field more does not compile before it is listed here.

template <typename Record, MaybeConst<UpPair> T>
void transfer(Record& record, T& value) {
  auto& [target, source] = value;
  record(target, source);
}

template <typename Record, MaybeConst<PairScreening> T>
void transfer(Record& record, T& value) {
  auto& [score, ups] = value;
  record(score, ups);
}

template <typename Record, MaybeConst<PoseCandidate> T>
void transfer(Record& record, T& value) {
  auto& [T_target_source, method, score, margin] = value;
  record(T_target_source, method, score, margin);
}

template <typename Record, MaybeConst<AlignmentEvidence> T>
void transfer(Record& record, T& value) {
  auto& [num_points, overlap, inlier_share, residual_m, tolerance_m, left, slide_m, left_across, num_across] = value;
  record(num_points, overlap, inlier_share, residual_m, tolerance_m, left, slide_m, left_across, num_across);
}

template <typename Record, MaybeConst<FreeSpaceEvidence> T>
void transfer(Record& record, T& value) {
  auto& [num_points, num_violating, num_matches, num_opposed] = value;
  record(num_points, num_violating, num_matches, num_opposed);
}

template <typename Record, MaybeConst<LinkMeasurements> T>
void transfer(Record& record, T& value) {
  auto& [evidence, other_overlap, other_inlier_share, free_space, sighted] = value;
  record(evidence, other_overlap, other_inlier_share, free_space, sighted);
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
  auto& [cells_across, max_grid, heading_step_deg, min_shared_share, max_candidates, vertical, map, grid] = value;
  record(cells_across, max_grid, heading_step_deg, min_shared_share, max_candidates, vertical, map, grid);
}

namespace {

// Cells are about as large: scores count them.
constexpr double kMostOff = 1.1;

bool are_alike(const CorrelationGrid& a, const CorrelationGrid& b) {
  return a.cell_m <= kMostOff * b.cell_m && b.cell_m <= kMostOff * a.cell_m;
}

double width_m(const CorrelationGrid& grid) { return grid.cell_m * grid.size; }

std::vector<const Cloud*> clouds_of(const std::vector<PreparedScan>& scans) {
  std::vector<const Cloud*> out;
  for (const auto& scan : scans) out.push_back(&scan.fine.cloud);
  return out;
}

/// The screenings of a set that was worked on before.
class KnownScreenings {
 public:
  KnownScreenings(const StepStore& store, const std::vector<std::string>& scans, const StepKey& key) {
    if (scans.empty()) return;
    auto all = find_step<std::vector<PairScreening>>(store, key);
    if (!all || all->size() != scans.size() * (scans.size() - 1) / 2) return;
    all_ = std::move(*all);
    for (std::size_t i = 0; i < scans.size(); ++i) place_[scans[i]] = i;
  }

  /// nullptr where it is not known: which of two is the target makes a difference.
  const PairScreening* find(const std::string& target, const std::string& source) const {
    const auto a = place_.find(target), b = place_.find(source);
    if (a == place_.end() || b == place_.end() || a->second > b->second) return nullptr;
    const std::size_t n = place_.size(), row = a->second;
    return &all_[row * n - row * (row + 1) / 2 + b->second - row - 1];
  }

 private:
  std::vector<PairScreening> all_;
  std::unordered_map<std::string, std::size_t> place_;
};

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

StepKey height_map_key(const PreparedScan& target, const PreparedScan& source, const std::vector<UpPair>& ups,
                       const HeightCorrelationOptions& options) {
  return step_key("height-maps", target.digest, source.digest, ups, options);
}

StepKey feature_key(const PreparedScan& target, const PreparedScan& source, const LinkSearchOptions& options) {
  return step_key("features", target.digest, source.digest, options.level);
}

StepKey slide_key(const PreparedScan& target, const PreparedScan& source, const std::vector<Eigen::Isometry3d>& from) {
  return step_key("slides", target.digest, source.digest, from);
}

std::string search_digest(const LinkSearchOptions& options) {
  const auto& [formulation, lp, level] = options;
  return step_key("searches", formulation, lp, level).digest;
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

std::vector<PoseCandidate> candidates_once(const StepStore& store, const StepKey& key,
                                           const std::function<std::vector<PoseCandidate>()>& search) {
  return do_once<std::vector<PoseCandidate>>(store, key, search);
}

const CorrelationGrid& grid_of_pair(const CorrelationGrid& a, const CorrelationGrid& b) {
  return width_m(a) != width_m(b) ? (width_m(a) > width_m(b) ? a : b) : (a.cell_m >= b.cell_m ? a : b);
}

std::vector<CorrelationGrid> grids_once(const StepStore& store, const std::vector<PreparedScan>& scans,
                                        const std::vector<std::string>& base, const HeightCorrelationOptions& options,
                                        int num_threads) {
  using Grids = std::vector<CorrelationGrid>;
  const std::vector<std::string> digests = digests_of(scans);
  const auto key = [&](const std::vector<std::string>& set) { return step_key("grids", set, options); };
  return do_once<Grids>(store, key(digests), [&] {
    const CorrelationGrid own = choose_correlation_grid(clouds_of(scans), options, num_threads);
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

std::vector<PairScreening> screenings_once(const StepStore& store, const std::vector<PreparedScan>& scans,
                                           const std::vector<std::string>& base,
                                           const std::vector<CorrelationGrid>& grids, HeightCorrelationOptions options,
                                           int num_threads) {
  const std::vector<std::string> digests = digests_of(scans);
  const StepKey key = step_key("rankings", digests, grids, options);
  return do_once<std::vector<PairScreening>>(store, key, [&] {
    std::unordered_map<std::string, CorrelationGrid> grid_of;
    for (std::size_t i = 0; i < scans.size(); ++i) grid_of[digests[i]] = grids[i];
    std::vector<CorrelationGrid> of_base;
    for (const auto& digest : base) of_base.push_back(grid_of[digest]);
    const KnownScreenings known(store, base, step_key("rankings", base, of_base, options));
    std::vector<PairScreening> out;
    // By width and cell of their grids: the pairs that are missing, and their places in `out`.
    std::map<std::pair<double, int>, std::pair<std::vector<ScanPair>, std::vector<std::size_t>>> missing;
    for (std::size_t a = 0; a < scans.size(); ++a) {
      for (std::size_t b = a + 1; b < scans.size(); ++b) {
        const PairScreening* before = known.find(digests[a], digests[b]);
        if (before == nullptr) {
          const CorrelationGrid& grid = grid_of_pair(grids[a], grids[b]);
          auto& [pairs, places] = missing[{grid.cell_m, grid.size}];
          pairs.push_back({a, b});
          places.push_back(out.size());
        }
        out.push_back(before != nullptr ? *before : PairScreening());
      }
    }
    for (const auto& [grid, wanted] : missing) {
      options.grid = {grid.first, grid.second};
      auto screened = screen_by_height_maps(clouds_of(scans), wanted.first, options, num_threads);
      for (std::size_t k = 0; k < screened.size(); ++k) out[wanted.second[k]] = std::move(screened[k]);
    }
    return out;
  });
}

std::optional<LinkHypothesis> fit_candidate_once(const StepStore* store, const PreparedScan& target,
                                                 const PreparedScan& source, const PoseCandidate& candidate,
                                                 const LinkSearchOptions& options) {
  if (store == nullptr) return fit_candidate(target, source, candidate, options);
  const auto& [formulation, lp, level] = options;
  const StepKey key = step_key("fits", target.digest, source.digest, candidate.T_target_source,
                               candidate.method == CoarseMethod::kSlide, formulation, lp);
  const auto fit = do_once<std::optional<Fit>>(*store, key, [&]() -> std::optional<Fit> {
    const auto found = fit_candidate(target, source, candidate, options);
    if (!found) return std::nullopt;
    return Fit{found->T_a_b, found->measurements};
  });
  if (!fit) return std::nullopt;
  return LinkHypothesis{fit->T_a_b, candidate, fit->measurements};
}

}  // namespace tcm_icp
