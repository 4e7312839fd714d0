#include "links/pair_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>

#include "core/acceptance.hpp"
#include "core/memory_budget.hpp"
#include "links/link_fit.hpp"
#include "links/pair_steps.hpp"
#include "tcm_icp/coarse/feature_alignment.hpp"
#include "tcm_icp/coarse/scan_words.hpp"
#include "tcm_icp/coarse/slide_search.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"
#include "tcm_icp/visibility/borders.hpp"

namespace tcm_icp {
namespace {

// Height maps first: they are cheap and cover a whole set at once. Local features are asked where those left scans
// alone, and then slides, which need poses to start from.

// A scan overlaps few others much. Where there are more, they are ranked. In a set so small that a scan may be compared
// with all others in the end, coarse height maps of all pairs do, which cost least; in others words choose, from scans
// that are described once.
constexpr std::size_t kFirstPartners = 6;
// Of those that look alike so many times as many are aligned by features, which tell far better who overlaps. Few scans
// that are left are aligned with more, as long as together they take no more than the first partners of all did: words
// are no use to those whose neighbours were seen from another side.
constexpr std::size_t kAlignedByReach = 4;
// Doubled twice: a scan that has no clear place by then would cost as much again for every scan of a large set.
constexpr std::size_t kMostPartners = 24;
// Bounds the cost in large sets. Fewer would not do: what tells a place from its twin is that all pairs there are poor.
constexpr std::size_t kImpliedPartners = 12;
// Of one pair. Of sets with clear places they are up to three, of rooms that look alike up to eleven; where no place is
// clear, every round puts scans elsewhere and asks again (docs/performance.md, hard sets).
constexpr std::size_t kMostImplied = 12;
constexpr std::size_t kSlidesOfPose = 8;  // from one pose
constexpr double kSameSlide = 2;          // [coarse voxels]
// Of a pair and method, beside those that free space vetoes; a clear hypothesis ends them.
constexpr int kMaxFits = 3;
// The pyramid's level at which poses are asked for overlap, and the distance of what overlaps, in its voxels.
constexpr std::size_t kOverlapLevel = 2;
constexpr double kOverlapInVoxels = 2;

// Each of the two may be off the vertical.
bool tilts(const Eigen::Isometry3d& T) { return T.linear()(2, 2) < std::cos(2 * kMaxLevelTilt_deg * EIGEN_PI / 180); }

SlideMarks slide_marks(const PreparedScan& scan, const Cloud& borders) {
  const Cloud& surfaces = scan.pyramid.level(0).cloud;
  if (!scan.sight.knows_sides()) return {surfaces, borders, NormalSides::kUnknown};
  return {{surfaces.points, scan.sight.facing}, borders, NormalSides::kSeen};
}

// The best voted for of those within a distance of one another, in this order: many poses slide to one.
std::vector<PoseCandidate> distinct(std::vector<PoseCandidate> slides, double distance_m, const PointMoments& moments) {
  std::stable_sort(slides.begin(), slides.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<PoseCandidate> out;
  for (const PoseCandidate& slide : slides) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const PoseCandidate& other) {
      return rms_displacement(other.T_target_source.inverse() * slide.T_target_source, moments) < distance_m;
    });
    if (!known) out.push_back(slide);
  }
  return out;
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

// Those with the `count` highest scores, the highest first.
void keep_best(const std::vector<double>& score_of_each, std::size_t count, std::vector<std::size_t>& scans) {
  if (scans.size() <= count) return;
  std::vector<std::pair<double, std::size_t>> by_score;
  for (std::size_t k = 0; k < scans.size(); ++k) by_score.emplace_back(-score_of_each[k], scans[k]);
  std::sort(by_score.begin(), by_score.end());
  scans.resize(count);
  for (std::size_t k = 0; k < count; ++k) scans[k] = by_score[k].second;
}

enum class Tried : char { kNothing, kHeightMaps, kFeatures, kSlides };

Tried next(Tried before) { return static_cast<Tried>(static_cast<char>(before) + 1); }

}  // namespace

struct PairSearch::Impl {
  using Alignments = std::map<std::pair<std::size_t, std::size_t>, std::vector<PoseCandidate>>;

  Impl(const std::vector<PreparedScan>& all, const LinkSearchOptions& o, const RunContext& c, KeptSearches k)
      : scans(all),
        options(o),
        context(c),
        kept(std::move(k)),
        steps(kept.store),
        height_maps(all, o.level, c, kept),
        reach(all.size(), kFirstPartners),
        borders(all.size()),
        found_borders(new std::once_flag[all.size()]) {}

  const std::vector<PreparedScan>& scans;
  const LinkSearchOptions& options;
  const RunContext& context;
  const KeptSearches kept;
  const StepStore* steps;  // that of `kept`
  HeightMapSearch height_maps;
  std::map<ScanPairs::value_type, Tried> tried;     // pairs that were
  std::vector<std::size_t> reach;                   // how many partners were asked for, of each scan
  std::vector<Cloud> borders;                       // once slides ask for them
  std::unique_ptr<std::once_flag[]> found_borders;  // the same
  FeatureAlignmentOptions features;
  std::vector<DescribedScan> described;                                                   // once they are asked for
  std::optional<ScanWords> words;                                                         // the same
  Alignments from_above;                                                                  // by height maps
  Alignments aligned, ranked;                                                             // by features
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Eigen::Isometry3d>> fitted;   // target and source
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Eigen::Isometry3d>> implied;  // that were tried
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::pair<Eigen::Isometry3d, double>>>
      overlaps;  // at poses

  double overlap_distance_m(std::size_t scan) const {
    return kOverlapInVoxels * scans[scan].pyramid.level(kOverlapLevel).voxel_size_m;
  }
  bool may_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
    return may_meet(scans[a], scans[b], T_a_b, overlap_distance_m(a));
  }

  std::vector<std::size_t> outside_group(std::size_t scan, const std::vector<std::size_t>& groups) const {
    std::vector<std::size_t> out;
    for (std::size_t j = 0; j < scans.size(); ++j) {
      if (groups[j] != groups[scan]) out.push_back(j);
    }
    return out;
  }

  /// Of a scan those outside its group, the likeliest first: at most as many as it reaches.
  /// @param num_wanted  how many scans are asked for theirs
  std::vector<std::size_t> partners(std::size_t scan, const std::vector<std::size_t>& groups, std::size_t num_wanted) {
    std::vector<std::size_t> out = outside_group(scan, groups);
    if (out.size() <= reach[scan]) return out;
    if (is_large()) {
      if (!words) {
        describe();
        words.emplace(described, context.num_threads);
      }
      const std::vector<double> likeness = words->likeness(scan);
      std::vector<double> of_others;
      for (const std::size_t j : out) of_others.push_back(likeness[j]);
      keep_best(of_others, std::max(kAlignedByReach * reach[scan], kFirstPartners * scans.size() / num_wanted), out);
    }
    keep_best_aligned(scan, reach[scan], out);
    return out;
  }

  /// Of a scan those that overlap most, as far as alignments tell.
  void keep_best_aligned(std::size_t scan, std::size_t count, std::vector<std::size_t>& others) {
    const ScanPairs pairs = pairs_with(scan, others);
    keep_best(is_large() ? feature_scores(pairs) : height_maps.scores(pairs), count, others);
  }

  static ScanPairs pairs_with(std::size_t scan, const std::vector<std::size_t>& others) {
    ScanPairs out;
    for (const std::size_t j : others) out.push_back(std::minmax(scan, j));
    return out;
  }

  /// Pairs of scans of different groups that were not tried: each with those that its height map is most like, and with
  /// those whose features align best, for neither tells all.
  ScanPairs pairs_between(const std::vector<std::size_t>& some, const std::vector<std::size_t>& groups) {
    ScanPairs all;
    for (std::size_t x = 0; x < some.size(); ++x) {
      for (std::size_t y = x + 1; y < some.size(); ++y) {
        if (groups[some[x]] != groups[some[y]]) all.push_back(std::minmax(some[x], some[y]));
      }
    }
    if (all.empty()) return {};
    by_height_maps(all);
    std::set<ScanPairs::value_type> chosen;
    for (const std::size_t i : some) {
      std::vector<std::size_t> others;
      std::copy_if(some.begin(), some.end(), std::back_inserter(others),
                   [&](std::size_t j) { return groups[j] != groups[i]; });
      const ScanPairs pairs = pairs_with(i, others);
      for (const auto& score : {best_scores(from_above, pairs), feature_scores(pairs)}) {
        auto best = others;
        keep_best(score, kFirstPartners, best);
        for (const std::size_t j : best) chosen.insert(std::minmax(i, j));
      }
    }
    std::erase_if(chosen, [&](const auto& pair) { return tried.contains(pair); });
    return {chosen.begin(), chosen.end()};
  }

  bool is_large() const { return scans.size() > kMostPartners + 1; }

  bool uses(Tried method) const {
    return method == Tried::kFeatures ? options.features : method != Tried::kSlides || options.slides;
  }

  // Inference of a large set costs more than the pairs of the few scans that it left without a place.
  bool all_methods_at_once(const std::vector<bool>& wanted) const {
    return is_large() && std::find(wanted.begin(), wanted.end(), false) != wanted.end();
  }

  /// Those of the first level alone, which tell who overlaps, too.
  std::vector<double> feature_scores(const ScanPairs& pairs) {
    FeatureAlignmentOptions first_level = features;
    first_level.levels.resize(1);
    align(pairs, first_level, ranking_key, ranked);
    return best_scores(ranked, pairs);
  }

  static std::vector<double> best_scores(const Alignments& known, const ScanPairs& pairs) {
    std::vector<double> out;
    for (const auto& pair : pairs) {
      const std::vector<PoseCandidate>& found = known.at(pair);
      out.push_back(found.empty() ? 0 : found.front().score);
    }
    return out;
  }

  /// By features, what was not yet.
  template <typename MakeKey>
  void align(const ScanPairs& pairs, const FeatureAlignmentOptions& by, const MakeKey& key, Alignments& known) {
    describe();
    ScanPairs open;
    for (const auto& pair : pairs) {
      if (!known.contains(pair)) open.push_back(pair);
    }
    std::vector<std::vector<PoseCandidate>> found(open.size());
    parallel_for(context.num_threads, open.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto [a, b] = open[k];
        found[k] = once([&, a = a, b = b] { return key(scans[a], scans[b], options); },
                        [&, a = a, b = b] { return aligned_by_features(a, b, by); });
      }
    });
    for (std::size_t k = 0; k < open.size(); ++k) known.emplace(open[k], std::move(found[k]));
  }

  std::vector<PoseCandidate> aligned_by_features(std::size_t a, std::size_t b,
                                                 const FeatureAlignmentOptions& by) const {
    auto found = align_by_features({scans[a].pyramid, described[a]}, {scans[b].pyramid, described[b]}, by);
    if (options.level) std::erase_if(found, [](const PoseCandidate& c) { return tilts(c.T_target_source); });
    return found;
  }

  /// All pairs that partners() would ask for one by one: together they share the scans' height maps and transforms.
  void screen_partners(const std::vector<bool>& wanted, const std::vector<std::size_t>& groups) {
    std::set<ScanPairs::value_type> asked;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!wanted[i]) continue;
      const std::vector<std::size_t> others = outside_group(i, groups);
      if (others.size() <= reach[i]) continue;
      for (const std::size_t j : others) asked.insert(std::minmax(i, j));
    }
    height_maps.scores({asked.begin(), asked.end()});
  }

  /// Pairs of each wanted scan with its likeliest partners outside its group, by what they were tried by.
  std::map<Tried, ScanPairs> pairs(const std::vector<bool>& wanted, const std::vector<std::size_t>& groups) {
    if (!is_large()) screen_partners(wanted, groups);
    std::set<ScanPairs::value_type> chosen;
    const auto num_wanted = static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), true));
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!wanted[i]) continue;
      for (const std::size_t j : partners(i, groups, num_wanted)) chosen.insert(std::minmax(i, j));
    }
    std::map<Tried, ScanPairs> out;
    for (const auto& pair : chosen) {
      const auto known = tried.find(pair);
      out[known == tried.end() ? Tried::kNothing : known->second].push_back(pair);
    }
    return out;
  }

  /// Twice as many partners for the wanted scans; false where they had all, or as many as there may be.
  bool reach_further(const std::vector<bool>& wanted) {
    bool more = false;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!wanted[i] || reach[i] >= std::min(kMostPartners, scans.size() - 1)) continue;
      reach[i] *= 2;
      more = true;
    }
    return more;
  }

  void describe() {
    if (!described.empty()) return;
    described.resize(scans.size());
    parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Rng rng = make_stream(context.seed, "features", scans[i].key);
        described[i] = in_budget(describe_scan(scans[i].pyramid, features, rng));
      }
    });
  }

  std::vector<std::vector<PoseCandidate>> by_height_maps(const ScanPairs& pairs) {
    ScanPairs open;
    for (const auto& pair : pairs) {
      if (!from_above.contains(pair)) open.push_back(pair);
    }
    auto found = height_maps.candidates(open, height_maps.grids_of(open));
    for (std::size_t k = 0; k < open.size(); ++k) from_above.emplace(open[k], std::move(found[k]));
    std::vector<std::vector<PoseCandidate>> out;
    for (const auto& pair : pairs) out.push_back(from_above.at(pair));
    return out;
  }

  std::vector<std::vector<PoseCandidate>> by_features(const ScanPairs& pairs) {
    align(pairs, features, feature_key, aligned);
    std::vector<std::vector<PoseCandidate>> out;
    for (const auto& pair : pairs) out.push_back(aligned.at(pair));
    return out;
  }

  /// From all poses that the pair was fitted to: where one is right but for a slide, it is most often one that free
  /// space vetoes.
  std::vector<std::vector<PoseCandidate>> by_slides(const ScanPairs& pairs) {
    std::vector<std::vector<PoseCandidate>> out(pairs.size());
    parallel_for(context.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto [a, b] = pairs[k];
        const auto known = fitted.find(pairs[k]);
        if (known == fitted.end()) continue;
        out[k] = once([&, a = a, b = b] { return slide_key(scans[a], scans[b], known->second); },
                      [&, a = a, b = b] { return slides_of(a, b, known->second); });
      }
    });
    return out;
  }

  const Cloud& borders_of(std::size_t scan) {
    std::call_once(found_borders[scan], [&] {
      borders[scan] = find_borders({scans[scan].pyramid.level(0), scans[scan].sight});
    });
    return borders[scan];
  }

  std::vector<PoseCandidate> slides_of(std::size_t a, std::size_t b, const std::vector<Eigen::Isometry3d>& poses) {
    const SlideMarks target = slide_marks(scans[a], borders_of(a)), source = slide_marks(scans[b], borders_of(b));
    const double voxel_m = scans[a].pyramid.level(0).voxel_size_m;
    std::vector<PoseCandidate> out;
    for (const Eigen::Isometry3d& T : poses) {
      const auto slid = slide_candidates(target, source, T, voxel_m, kSlidesOfPose);
      out.insert(out.end(), slid.begin(), slid.end());
    }
    return distinct(std::move(out), kSameSlide * voxel_m, scans[b].moments);
  }

  /// A search that is kept, where anything is.
  template <typename MakeKey, typename Search>
  std::vector<PoseCandidate> once(const MakeKey& key, const Search& search) const {
    return steps != nullptr ? candidates_once(*steps, key(), search) : search();
  }

  /// Pairs that were tried by `before` by the method after it; false where that is left out.
  bool try_next(Tried before, const ScanPairs& pairs, bool is_later, HypothesisSet& set) {
    const bool is_used = uses(next(before));
    if (is_used) fit(pairs, candidates(before, pairs), is_later, set);
    for (const auto& pair : pairs) tried[pair] = next(before);
    return is_used;
  }

  /// By the method after `before`.
  std::vector<std::vector<PoseCandidate>> candidates(Tried before, const ScanPairs& pairs) {
    switch (before) {
      case Tried::kNothing:
        context.report("comparing height maps", 0, pairs.size());
        return by_height_maps(pairs);
      case Tried::kHeightMaps:
        context.report("comparing features", 0, pairs.size());
        return by_features(pairs);
      default:
        context.report("comparing along corridors", 0, pairs.size());
        return by_slides(pairs);
    }
  }

  /// At each of the poses; known ones within `same_m` of them are not asked again. Most of what an inference implies
  /// the one before implied, too.
  std::vector<double> overlaps_at(const std::vector<ImpliedPose>& poses, double same_m) {
    std::vector<double> out(poses.size(), 0);
    std::vector<char> is_new(poses.size(), 0);
    parallel_for(context.num_threads, poses.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t a = poses[k].a, b = poses[k].b;
        const Eigen::Isometry3d& T_a_b = poses[k].T_a_b;
        if (!may_overlap(a, b, T_a_b)) continue;
        if (const auto known = known_overlap(a, b, T_a_b, same_m)) {
          out[k] = *known;
          continue;
        }
        const PyramidLevel &x = scans[a].pyramid.level(kOverlapLevel), &y = scans[b].pyramid.level(kOverlapLevel);
        out[k] = overlap(x, y, T_a_b, overlap_distance_m(a));
        is_new[k] = 1;
      }
    });
    for (std::size_t k = 0; k < poses.size(); ++k) {
      if (is_new[k] != 0) overlaps[{poses[k].a, poses[k].b}].emplace_back(poses[k].T_a_b, out[k]);
    }
    return out;
  }

  std::optional<double> known_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b,
                                      double same_m) const {
    const auto known = overlaps.find({a, b});
    if (known == overlaps.end()) return std::nullopt;
    for (const auto& [T, share] : known->second) {
      if (rms_displacement(T_a_b.inverse() * T, scans[b].moments) < same_m) return share;
    }
    return std::nullopt;
  }

  /// Fits pairs at given poses where they overlap there; of each scan those with the `most_partners` it overlaps with
  /// most. False where there was none, or all were tried before.
  bool try_poses(const std::vector<ImpliedPose>& poses, CoarseMethod method, std::size_t most_partners,
                 HypothesisSet& set) {
    std::map<ScanPairs::value_type, std::vector<PoseCandidate>> wanted;
    for (const std::size_t k : most_overlapping(poses, overlaps_at(poses, set.same_m()), most_partners)) {
      if (poses[k].agrees) continue;
      const std::size_t a = poses[k].a, b = poses[k].b;
      const Eigen::Isometry3d& T_a_b = poses[k].T_a_b;
      std::vector<Eigen::Isometry3d>& before = implied[{a, b}];
      const auto has_within = [&](const std::vector<Eigen::Isometry3d>& known, double distance_m) {
        return std::any_of(known.begin(), known.end(), [&](const Eigen::Isometry3d& T) {
          return rms_displacement(T_a_b.inverse() * T, scans[b].moments) < distance_m;
        });
      };
      const bool enough = method == CoarseMethod::kImplied && before.size() >= kMostImplied;
      if (enough || has_within(before, set.fitted_m())) continue;
      before.push_back(T_a_b);
      const auto fits = fitted.find({a, b});
      const bool there = fits != fitted.end() && has_within(fits->second, set.same_m());
      wanted[{a, b}].push_back({T_a_b, method, 1, 1, there});
    }
    ScanPairs pairs;
    std::vector<std::vector<PoseCandidate>> candidates;
    for (auto& [pair, found] : wanted) {
      pairs.push_back(pair);
      candidates.push_back(std::move(found));
    }
    if (!pairs.empty()) fit(pairs, candidates, false, set);
    return !pairs.empty();
  }

  /// The most promising candidate of every pair, then the next of pairs that have no clear hypothesis yet: what the set
  /// shows by then tells which have one.
  void fit(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates, bool is_later,
           HypothesisSet& set) {
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
        found[i]->is_later = is_later;
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
  FirstPairs out;
  out.pairs = impl_->pairs(std::vector<bool>(n, true), groups)[Tried::kNothing];
  out.grids = impl_->height_maps.grids_of(out.pairs);
  return out;
}

void PairSearch::match(const FirstPairs& first) {
  const auto candidates = impl_->height_maps.candidates(first.pairs, first.grids);
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

std::size_t PairSearch::most_between() const {
  return impl_->is_large() ? static_cast<std::size_t>(std::sqrt(1.0 * kFirstPartners * impl_->scans.size())) : 0;
}

bool PairSearch::try_between(const std::vector<std::size_t>& some, const std::vector<std::size_t>& groups,
                             HypothesisSet& set) {
  const ScanPairs pairs = impl_->pairs_between(some, groups);
  if (pairs.empty()) return false;
  for (const Tried before : {Tried::kNothing, Tried::kHeightMaps, Tried::kFeatures}) {
    impl_->try_next(before, pairs, true, set);
  }
  return true;
}

bool PairSearch::extend(const std::vector<bool>& wanted, const std::vector<std::size_t>& groups, HypothesisSet& set) {
  const bool is_later = !impl_->tried.empty();
  do {
    auto pairs = impl_->pairs(wanted, groups);
    bool any = false;
    for (const Tried before : {Tried::kNothing, Tried::kHeightMaps, Tried::kFeatures}) {
      const ScanPairs& now = pairs[before];
      if (now.empty()) continue;
      const bool is_used = impl_->try_next(before, now, is_later, set);
      any = any || is_used;
      if (is_used && !impl_->all_methods_at_once(wanted)) break;
      ScanPairs& later = pairs[next(before)];
      later.insert(later.end(), now.begin(), now.end());
      std::sort(later.begin(), later.end());
    }
    if (any) return true;
  } while (impl_->reach_further(wanted));
  return false;
}

}  // namespace tcm_icp
