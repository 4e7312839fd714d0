#include "links/pair_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "core/acceptance.hpp"
#include "links/link_fit.hpp"
#include "links/pair_steps.hpp"
#include "tcm_icp/coarse/feature_alignment.hpp"
#include "tcm_icp/coarse/height_correlation.hpp"
#include "tcm_icp/coarse/slide_search.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

// Height maps first: they are cheap and cover a whole set at once. Local features are asked where those left scans
// alone, and then slides, which need poses to start from.

// A scan overlaps few others much. Where there are more, all pairs are ranked at little cost first.
constexpr std::size_t kFirstPartners = 6;
// Doubled twice: a scan that has no clear place by then would cost as much again for every scan of a large set.
constexpr std::size_t kMostPartners = 24;
// Bounds the cost in large sets. Fewer would not do: what tells a place from its twin is that all pairs there are poor.
constexpr std::size_t kImpliedPartners = 12;
constexpr std::size_t kSlidesOfPose = 8;  // from one pose
// Of a pair and method, beside those that free space vetoes; a clear hypothesis ends them.
constexpr int kMaxFits = 3;
// The pyramid's level at which poses are asked for overlap, and the distance of what overlaps, in its voxels.
constexpr std::size_t kOverlapLevel = 2;
constexpr double kOverlapInVoxels = 2;
// Pairs whose height maps are compared together: they share transforms; what is cut off is done again.
constexpr std::size_t kBlock = 100;

// Each of the two may be off the vertical.
bool tilts(const Eigen::Isometry3d& T) { return T.linear()(2, 2) < std::cos(2 * kMaxLevelTilt_deg * EIGEN_PI / 180); }

Cloud surfaces(const PreparedScan& scan, NormalSides sides) {
  const Cloud& cloud = scan.pyramid.level(0).cloud;
  return sides == NormalSides::kSeen ? Cloud{cloud.points, scan.sight.facing} : cloud;
}

// Those that overlap at all and are, for either scan and in their configuration, among the `most_partners` best;
// ascending.
std::vector<std::size_t> most_overlapping(const std::vector<ImpliedPose>& poses, const std::vector<double>& overlaps,
                                          std::size_t most_partners) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> of_scan;  // by configuration and scan
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (overlaps[k] < kGuessedOverlap) continue;
    for (const std::size_t i : {poses[k].a, poses[k].b}) of_scan[{poses[k].configuration, i}].push_back(k);
  }
  std::set<std::size_t> out;
  for (auto& [place, all] : of_scan) {
    std::stable_sort(all.begin(), all.end(), [&](std::size_t x, std::size_t y) { return overlaps[x] > overlaps[y]; });
    out.insert(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(most_partners, all.size())));
  }
  return {out.begin(), out.end()};
}

enum class Tried : char { kNothing, kHeightMaps, kFeatures, kSlides };

}  // namespace

struct PairSearch::Impl {
  Impl(const std::vector<PreparedScan>& all, const LinkSearchOptions& o, const RunContext& c, KeptSearches k)
      : scans(all),
        options(o),
        context(c),
        kept(std::move(k)),
        steps(kept.store),
        tried(all.size() * all.size(), Tried::kNothing) {}

  const std::vector<PreparedScan>& scans;
  const LinkSearchOptions& options;
  const RunContext& context;
  const KeptSearches kept;
  const StepStore* steps;                    // that of `kept`
  std::vector<CorrelationGrid> given_grids;  // of height maps, for pairs of a larger set
  std::vector<Tried> tried;                  // by pair, a * n + b
  std::vector<PairScreening> screened;       // by pair, the same
  std::vector<std::vector<std::size_t>> partners;
  std::vector<std::size_t> reach;  // how many of them were asked for, of each scan
  FeatureAlignmentOptions features;
  std::vector<DescribedScan> described;                                                   // once they are asked for
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Eigen::Isometry3d>> fitted;   // target and source
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Eigen::Isometry3d>> implied;  // that were tried

  const PairScreening& screening_of(std::size_t a, std::size_t b) const {
    return screened[std::min(a, b) * scans.size() + std::max(a, b)];
  }
  Tried& state(std::size_t a, std::size_t b) { return tried[std::min(a, b) * scans.size() + std::max(a, b)]; }

  double overlap_distance_m(std::size_t scan) const {
    return kOverlapInVoxels * scans[scan].pyramid.level(kOverlapLevel).voxel_size_m;
  }
  bool may_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
    return may_meet(scans[a], scans[b], T_a_b, overlap_distance_m(a));
  }

  /// Pairs of the state wanted, of each wanted scan with its likeliest partners outside its group.
  ScanPairs pairs(Tried state_wanted, const std::vector<bool>& wanted, const std::vector<std::size_t>& groups) {
    std::vector<bool> chosen(scans.size() * scans.size(), false);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!wanted[i]) continue;
      std::size_t count = 0;
      for (const std::size_t j : partners[i]) {
        if (groups[j] == groups[i]) continue;
        if (count++ == reach[i]) break;
        chosen[std::min(i, j) * scans.size() + std::max(i, j)] = true;
      }
    }
    ScanPairs out;
    for (std::size_t a = 0; a < scans.size(); ++a) {
      for (std::size_t b = a + 1; b < scans.size(); ++b) {
        if (chosen[a * scans.size() + b] && state(a, b) == state_wanted) out.emplace_back(a, b);
      }
    }
    return out;
  }

  /// Of each scan all others, the likeliest to overlap first.
  void rank_partners() {
    const std::size_t n = scans.size();
    if (!partners.empty()) return;
    partners.resize(n);
    reach.assign(n, kFirstPartners);
    screened.resize(n * n);
    context.report("ranking pairs", 0, n * (n - 1) / 2);
    std::vector<ScanPair> all;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b) all.push_back({a, b});
    }
    HeightCorrelationOptions screening = screening_options();
    screening.vertical.levelled = options.level;
    auto screenings = screen(all, screening);
    for (std::size_t k = 0; k < all.size(); ++k) screened[all[k].target * n + all[k].source] = std::move(screenings[k]);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (j != i) partners[i].push_back(j);
      }
      std::stable_sort(partners[i].begin(), partners[i].end(), [&](std::size_t x, std::size_t y) {
        const double a = screening_of(i, x).score, b = screening_of(i, y).score;
        return a != b ? a > b : x < y;
      });
    }
  }

  std::vector<PairScreening> screen(const std::vector<ScanPair>& all, HeightCorrelationOptions screening) const {
    if (steps == nullptr) return screen_by_height_maps(all_clouds(), all, screening, context.num_threads);
    const auto grids = grids_once(*steps, scans, kept.base, screening, context.num_threads);
    return screenings_once(*steps, scans, kept.base, grids, screening, context.num_threads);
  }

  std::vector<const Cloud*> all_clouds() const {
    std::vector<const Cloud*> out;
    for (const auto& scan : scans) out.push_back(&scan.fine.cloud);
    return out;
  }

  /// Twice as many partners for the wanted scans; false where they had all, or as many as there may be.
  bool reach_further(const std::vector<bool>& wanted) {
    bool more = false;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!wanted[i] || reach[i] >= std::min(kMostPartners, partners[i].size())) continue;
      reach[i] *= 2;
      more = true;
    }
    return more;
  }

  /// Those of the pairs that are kept; of the others, a block at a time is searched and kept.
  std::vector<std::vector<PoseCandidate>> by_height_maps(const ScanPairs& pairs) const {
    HeightCorrelationOptions correlation = height_map_options();
    if (steps == nullptr) return search_height_maps(pairs, correlation);
    const std::vector<CorrelationGrid> grids = grids_of(pairs);
    std::vector<std::vector<PoseCandidate>> out(pairs.size());
    std::map<std::pair<double, int>, std::vector<std::size_t>> missing;  // by grid
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      correlation.grid = grids[k];
      auto known = find_candidates(*steps, height_map_key_of(pairs[k], correlation));
      if (known) out[k] = std::move(*known);
      if (!known) missing[{grids[k].cell_m, grids[k].size}].push_back(k);
    }
    for (const auto& [grid, places] : missing) {
      correlation.grid = {grid.first, grid.second};
      search_in_blocks(pairs, places, correlation, out);
    }
    return out;
  }

  /// The pairs at these places.
  void search_in_blocks(const ScanPairs& pairs, const std::vector<std::size_t>& places,
                        const HeightCorrelationOptions& correlation,
                        std::vector<std::vector<PoseCandidate>>& out) const {
    const std::size_t num_blocks = (places.size() + kBlock - 1) / kBlock;
    for (std::size_t number = 0; number < num_blocks; ++number) {
      const std::size_t first = places.size() * number / num_blocks;
      const std::size_t size = places.size() * (number + 1) / num_blocks - first;
      context.report("comparing height maps", first, places.size());
      ScanPairs block;
      for (std::size_t i = first; i < first + size; ++i) block.push_back(pairs[places[i]]);
      const auto start = std::chrono::steady_clock::now();
      auto found = search_height_maps(block, correlation);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      for (std::size_t i = 0; i < size; ++i) {
        save_candidates(*steps, height_map_key_of(block[i], correlation), found[i],
                        elapsed.count() / static_cast<double>(size));
        out[places[first + i]] = std::move(found[i]);
      }
    }
  }

  HeightCorrelationOptions height_map_options() const {
    HeightCorrelationOptions correlation;
    correlation.vertical.levelled = options.level;
    return correlation;
  }

  /// Of each pair; those of the set where all of it is compared.
  std::vector<CorrelationGrid> grids_of(const ScanPairs& pairs) const {
    if (!given_grids.empty()) return given_grids;
    const std::vector<const Cloud*> clouds = clouds_of(pairs);
    const HeightCorrelationOptions correlation = height_map_options();
    if (steps == nullptr || clouds.size() < scans.size()) {
      return std::vector<CorrelationGrid>(pairs.size(),
                                          choose_correlation_grid(clouds, correlation, context.num_threads));
    }
    const auto of_scans = grids_once(*steps, scans, kept.base, correlation, context.num_threads);
    std::vector<CorrelationGrid> out;
    for (const auto& [a, b] : pairs) out.push_back(grid_of_pair(of_scans[a], of_scans[b]));
    return out;
  }

  StepKey height_map_key_of(const ScanPairs::value_type& pair, const HeightCorrelationOptions& correlation) const {
    const auto [a, b] = pair;
    return height_map_key(scans[a], scans[b], screening_of(a, b).ups, correlation);
  }

  /// Of the scans that are in a pair.
  std::vector<const Cloud*> clouds_of(const ScanPairs& pairs) const {
    std::vector<bool> is_in(scans.size(), false);
    for (const auto& [a, b] : pairs) is_in[a] = is_in[b] = true;
    std::vector<const Cloud*> out;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (is_in[i]) out.push_back(&scans[i].fine.cloud);
    }
    return out;
  }

  std::vector<std::vector<PoseCandidate>> search_height_maps(const ScanPairs& pairs,
                                                             const HeightCorrelationOptions& correlation) const {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<const Cloud*> clouds;  // of the scans that are in a pair
    std::vector<std::size_t> place(scans.size(), kNone);
    std::vector<ScanPair> wanted;
    for (const auto& [a, b] : pairs) {
      for (const std::size_t i : {a, b}) {
        if (place[i] != kNone) continue;
        place[i] = clouds.size();
        clouds.push_back(&scans[i].fine.cloud);
      }
      wanted.push_back({place[a], place[b], screening_of(a, b).ups});
    }
    return correlate_height_maps(clouds, wanted, correlation, context.num_threads);
  }

  /// The scans of the pairs that are `wanted`.
  void describe(const ScanPairs& pairs, const std::vector<char>& wanted) {
    described.resize(scans.size());
    std::vector<char> missing(scans.size(), 0);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      for (const std::size_t i : {pairs[k].first, pairs[k].second}) {
        if (wanted[k] != 0 && described[i].levels.empty()) missing[i] = 1;
      }
    }
    parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (missing[i] == 0) continue;
        Rng rng = make_stream(context.seed, "features", scans[i].key);
        described[i] = describe_scan(scans[i].pyramid, features, rng);
      }
    });
  }

  std::vector<std::vector<PoseCandidate>> by_features(const ScanPairs& pairs) {
    std::vector<std::vector<PoseCandidate>> out(pairs.size());
    std::vector<char> missing(pairs.size(), 1);
    for (std::size_t k = 0; k < pairs.size() && steps != nullptr; ++k) {
      auto known = find_candidates(*steps, feature_key(scans[pairs[k].first], scans[pairs[k].second], options));
      if (!known) continue;
      out[k] = std::move(*known);
      missing[k] = 0;
    }
    describe(pairs, missing);
    const auto search = [&](std::size_t a, std::size_t b) {
      auto found = align_by_features({scans[a].pyramid, described[a]}, {scans[b].pyramid, described[b]}, features);
      if (options.level) std::erase_if(found, [](const PoseCandidate& c) { return tilts(c.T_target_source); });
      return found;
    };
    parallel_for(context.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        if (missing[k] == 0) continue;
        const auto [a, b] = pairs[k];
        out[k] = once([&, a = a, b = b] { return feature_key(scans[a], scans[b], options); },
                      [&, a = a, b = b] { return search(a, b); });
      }
    });
    return out;
  }

  /// From all poses that the pair was fitted to: where one is right but for a slide, it is most often one that free
  /// space vetoes.
  std::vector<std::vector<PoseCandidate>> by_slides(const ScanPairs& pairs) const {
    std::vector<std::vector<PoseCandidate>> out(pairs.size());
    parallel_for(context.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto [a, b] = pairs[k];
        const auto known = fitted.find(pairs[k]);
        if (known == fitted.end()) continue;
        out[k] = once([&, a = a, b = b] { return slide_key(scans[a], scans[b], known->second); },
                      [&, a = a, b = b] { return slides_of(scans[a], scans[b], known->second); });
      }
    });
    return out;
  }

  static std::vector<PoseCandidate> slides_of(const PreparedScan& a, const PreparedScan& b,
                                              const std::vector<Eigen::Isometry3d>& poses) {
    const bool seen = a.sight.knows_sides() && b.sight.knows_sides();
    const NormalSides sides = seen ? NormalSides::kSeen : NormalSides::kUnknown;
    const Cloud target = surfaces(a, sides), source = surfaces(b, sides);
    const double voxel_m = a.pyramid.level(0).voxel_size_m;
    std::vector<PoseCandidate> out;
    for (const Eigen::Isometry3d& T : poses) {
      const auto slid = slide_candidates(target, source, T, voxel_m, sides, kSlidesOfPose);
      out.insert(out.end(), slid.begin(), slid.end());
    }
    return out;
  }

  /// A search that is kept, where anything is.
  template <typename MakeKey, typename Search>
  std::vector<PoseCandidate> once(const MakeKey& key, const Search& search) const {
    return steps != nullptr ? candidates_once(*steps, key(), search) : search();
  }

  /// Fits pairs at given poses where they overlap there; of each scan those with the `most_partners` it overlaps with
  /// most. False where there was none, or all were tried before.
  bool try_poses(const std::vector<ImpliedPose>& poses, CoarseMethod method, std::size_t most_partners,
                 HypothesisSet& set) {
    std::map<ScanPairs::value_type, std::vector<PoseCandidate>> wanted;
    std::vector<double> overlaps(poses.size(), 0);
    parallel_for(context.num_threads, poses.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto& [a, b, T_a_b, agrees, configuration] = poses[k];
        const PyramidLevel &x = scans[a].pyramid.level(kOverlapLevel), &y = scans[b].pyramid.level(kOverlapLevel);
        if (!may_overlap(a, b, T_a_b)) continue;
        overlaps[k] = overlap({x.cloud.points, x.index}, {y.cloud.points, y.index}, T_a_b, overlap_distance_m(a));
      }
    });
    for (const std::size_t k : most_overlapping(poses, overlaps, most_partners)) {
      if (poses[k].agrees) continue;
      const std::size_t a = poses[k].a, b = poses[k].b;
      const Eigen::Isometry3d& T_a_b = poses[k].T_a_b;
      std::vector<Eigen::Isometry3d>& before = implied[{a, b}];
      const bool known = std::any_of(before.begin(), before.end(), [&](const Eigen::Isometry3d& T) {
        return rms_displacement(T_a_b.inverse() * T, scans[b].moments) < set.same_m();
      });
      if (known) continue;
      before.push_back(T_a_b);
      wanted[{a, b}].push_back({T_a_b, method, 1, 1});
    }
    ScanPairs pairs;
    std::vector<std::vector<PoseCandidate>> candidates;
    for (auto& [pair, found] : wanted) {
      pairs.push_back(pair);
      candidates.push_back(std::move(found));
    }
    if (!pairs.empty()) fit(pairs, candidates, set);
    return !pairs.empty();
  }

  /// The most promising candidate of every pair, then the next of pairs that have no clear hypothesis yet: what the set
  /// shows by then tells which have one.
  void fit(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates, HypothesisSet& set) {
    std::vector<std::vector<PoseCandidate>> queues(pairs.size());
    parallel_for(context.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        queues[k] = in_order_of_promise(scans[pairs[k].first], scans[pairs[k].second], candidates[k]);
        std::reverse(queues[k].begin(), queues[k].end());
      }
    });
    for (const auto& [a, b] : pairs) set.add(a, b, {});
    std::vector<std::size_t> open(pairs.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    std::vector<int> num_fits(pairs.size(), 0);
    while (!open.empty()) {
      std::vector<std::optional<LinkHypothesis>> found(open.size());
      parallel_for(context.num_threads, open.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto [a, b] = pairs[open[i]];
          std::vector<PoseCandidate>& queue = queues[open[i]];
          while (!queue.empty() && !found[i]) {
            found[i] = fit_candidate_once(steps, scans[a], scans[b], queue.back(), options);
            queue.pop_back();
          }
        }
      });
      for (std::size_t i = 0; i < open.size(); ++i) {
        if (!found[i]) continue;
        const auto [a, b] = pairs[open[i]];
        fitted[{a, b}].push_back(found[i]->T_a_b);
        if (!found[i]->measurements.free_space.vetoes()) ++num_fits[open[i]];
        set.add(a, b, {*found[i]});
      }
      set.score();
      std::erase_if(open, [&](std::size_t k) {
        return queues[k].empty() || num_fits[k] == kMaxFits ||
               set.log_odds(pairs[k].first, pairs[k].second) >= kClearLogOdds;
      });
    }
  }
};

PairSearch::PairSearch(const std::vector<PreparedScan>& scans, const LinkSearchOptions& options,
                       const RunContext& context, KeptSearches kept)
    : impl_(new Impl(scans, options, context, std::move(kept))) {}
PairSearch::~PairSearch() = default;

void PairSearch::try_guesses(const std::vector<std::optional<Eigen::Isometry3d>>& T_common_scan, HypothesisSet& set) {
  std::vector<ImpliedPose> poses;
  for (std::size_t a = 0; a < T_common_scan.size(); ++a) {
    for (std::size_t b = a + 1; b < T_common_scan.size(); ++b) {
      if (!T_common_scan[a] || !T_common_scan[b]) continue;
      const Eigen::Isometry3d T_a_b = T_common_scan[a]->inverse() * *T_common_scan[b];
      if (may_overlap(a, b, T_a_b)) poses.push_back({a, b, T_a_b});
    }
  }
  impl_->try_poses(poses, CoarseMethod::kGuess, poses.size(), set);
}

FirstPairs PairSearch::first_pairs() {
  const std::size_t n = impl_->scans.size();
  std::vector<std::size_t> groups(n);
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  impl_->rank_partners();
  FirstPairs out;
  out.pairs = impl_->pairs(Tried::kNothing, std::vector<bool>(n, true), groups);
  for (const auto& [a, b] : out.pairs) out.ups.push_back(impl_->screening_of(a, b).ups);
  out.grids = impl_->grids_of(out.pairs);
  return out;
}

void PairSearch::match(const FirstPairs& first) {
  impl_->given_grids = first.grids;
  impl_->screened.resize(impl_->scans.size() * impl_->scans.size());
  for (std::size_t k = 0; k < first.pairs.size(); ++k) {
    const auto [a, b] = first.pairs[k];
    impl_->screened[a * impl_->scans.size() + b].ups = first.ups[k];
  }
  const auto candidates = impl_->by_height_maps(first.pairs);
  impl_->context.report("fitting", 0, first.pairs.size());
  parallel_for(impl_->context.num_threads, first.pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const PreparedScan &a = impl_->scans[first.pairs[k].first], &b = impl_->scans[first.pairs[k].second];
      for (const PoseCandidate& candidate : in_order_of_promise(a, b, candidates[k])) {
        if (fit_candidate_once(impl_->steps, a, b, candidate, impl_->options)) break;
      }
    }
  });
}

bool PairSearch::may_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
  return impl_->may_overlap(a, b, T_a_b);
}

bool PairSearch::try_implied(const std::vector<ImpliedPose>& poses, HypothesisSet& set) {
  return impl_->try_poses(poses, CoarseMethod::kImplied, kImpliedPartners, set);
}

bool PairSearch::extend(const std::vector<bool>& wanted, const std::vector<std::size_t>& groups, HypothesisSet& set) {
  impl_->rank_partners();
  do {
    if (const ScanPairs pairs = impl_->pairs(Tried::kNothing, wanted, groups); !pairs.empty()) {
      impl_->context.report("comparing height maps", 0, pairs.size());
      impl_->fit(pairs, impl_->by_height_maps(pairs), set);
      for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kHeightMaps;
      return true;
    }
    if (const ScanPairs pairs = impl_->pairs(Tried::kHeightMaps, wanted, groups); !pairs.empty()) {
      impl_->context.report("comparing features", 0, pairs.size());
      impl_->fit(pairs, impl_->by_features(pairs), set);
      for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kFeatures;
      return true;
    }
    if (const ScanPairs pairs = impl_->pairs(Tried::kFeatures, wanted, groups); !pairs.empty()) {
      impl_->context.report("comparing along corridors", 0, pairs.size());
      impl_->fit(pairs, impl_->by_slides(pairs), set);
      for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kSlides;
      return true;
    }
  } while (impl_->reach_further(wanted));
  return false;
}

}  // namespace tcm_icp
