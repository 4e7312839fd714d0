#include "links/pair_steps.hpp"

#include <unordered_map>

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

// A grid serves where its cells are about as large, and it is about as wide: wider than the widest scan it is anyway.
constexpr double kMostOff = 1.1;

bool serves(const CorrelationGrid& kept, const CorrelationGrid& own) {
  const bool alike = kept.cell_m <= kMostOff * own.cell_m && own.cell_m <= kMostOff * kept.cell_m;
  return alike && own.cell_m * own.size <= kMostOff * kept.cell_m * kept.size;
}

std::vector<const Cloud*> clouds_of(const std::vector<PreparedScan>& scans) {
  std::vector<const Cloud*> out;
  for (const auto& scan : scans) out.push_back(&scan.fine.cloud);
  return out;
}

/// The screenings of a set that was worked on before.
class KnownScreenings {
 public:
  KnownScreenings(const StepStore& store, const std::vector<std::string>& scans,
                  const HeightCorrelationOptions& options) {
    if (scans.empty()) return;
    auto all = find_step<std::vector<PairScreening>>(store, screening_key(scans, options));
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

StepKey grid_key(const std::vector<std::string>& scans, const HeightCorrelationOptions& options) {
  return step_key("grids", scans, options);
}

StepKey screening_key(const std::vector<std::string>& scans, const HeightCorrelationOptions& options) {
  return step_key("rankings", scans, options);
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

CorrelationGrid grid_once(const StepStore& store, const std::vector<PreparedScan>& scans,
                          const std::vector<std::string>& base, const HeightCorrelationOptions& options,
                          int num_threads) {
  return do_once<CorrelationGrid>(store, grid_key(digests_of(scans), options), [&] {
    const CorrelationGrid own = choose_correlation_grid(clouds_of(scans), options, num_threads);
    const auto kept = base.empty() ? std::nullopt : find_step<CorrelationGrid>(store, grid_key(base, options));
    return kept && serves(*kept, own) ? *kept : own;
  });
}

std::vector<PairScreening> screenings_once(const StepStore& store, const std::vector<PreparedScan>& scans,
                                           const std::vector<std::string>& base,
                                           const HeightCorrelationOptions& options, int num_threads) {
  const std::vector<std::string> digests = digests_of(scans);
  return do_once<std::vector<PairScreening>>(store, screening_key(digests, options), [&] {
    const KnownScreenings known(store, base, options);
    std::vector<ScanPair> missing;
    std::vector<PairScreening> out;
    std::vector<std::size_t> places;
    for (std::size_t a = 0; a < scans.size(); ++a) {
      for (std::size_t b = a + 1; b < scans.size(); ++b) {
        const PairScreening* before = known.find(digests[a], digests[b]);
        if (before == nullptr) {
          missing.push_back({a, b});
          places.push_back(out.size());
        }
        out.push_back(before != nullptr ? *before : PairScreening());
      }
    }
    auto screened = screen_by_height_maps(clouds_of(scans), missing, options, num_threads);
    for (std::size_t k = 0; k < places.size(); ++k) out[places[k]] = std::move(screened[k]);
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
