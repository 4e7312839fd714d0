#include "links/pair_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

#include "links/feature_search.hpp"
#include "links/overlaps_at_poses.hpp"
#include "links/pair_fits.hpp"
#include "links/slides_from_fits.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

// Height maps first: they are cheap and cover a whole set at once. Local features are asked where those left scans
// alone, then slides, which need poses to start from, and then more of what height maps and features found.

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

// Those with the `count` highest scores, the highest first.
void keep_best(const std::vector<double>& score_of_each, std::size_t count, std::vector<std::size_t>& scans) {
  if (scans.size() <= count) return;
  std::vector<std::pair<double, std::size_t>> by_score;
  for (std::size_t k = 0; k < scans.size(); ++k) by_score.emplace_back(-score_of_each[k], scans[k]);
  std::sort(by_score.begin(), by_score.end());
  scans.resize(count);
  for (std::size_t k = 0; k < count; ++k) scans[k] = by_score[k].second;
}

// By which methods a pair was tried, the cheap ones first.
enum class Tried : char { kNothing, kHeightMaps, kFeatures, kSlides, kDeepHeightMaps, kDeepFeatures };

constexpr Tried kMethodsBefore[] = {Tried::kNothing, Tried::kHeightMaps, Tried::kFeatures, Tried::kSlides,
                                    Tried::kDeepHeightMaps};

bool is_deep(Tried method) { return method == Tried::kDeepHeightMaps || method == Tried::kDeepFeatures; }

Tried next(Tried before) { return static_cast<Tried>(static_cast<char>(before) + 1); }

}  // namespace

struct PairSearch::Impl {
  Impl(const std::vector<PreparedScan>& all, const LinkSearchOptions& o, const RunContext& c, KeptSearches k)
      : scans(all),
        options(o),
        context(c),
        kept(std::move(k)),
        height_maps(all, o.level, c, kept),
        features(all, o, c, kept.store),
        fits(all, o, c, kept.store),
        slides(all, fits, c, kept.store),
        overlaps(all, c.num_threads),
        reach(all.size(), kFirstPartners) {}

  const std::vector<PreparedScan>& scans;
  const LinkSearchOptions& options;
  const RunContext& context;
  const KeptSearches kept;
  HeightMapSearch height_maps;
  FeatureSearch features;
  PairFits fits;
  SlidesFromFits slides;
  OverlapsAtPoses overlaps;
  std::map<ScanPairs::value_type, Tried> tried;                             // pairs that were
  std::vector<std::size_t> reach;                                           // how many partners were asked for, of each
  std::map<ScanPairs::value_type, std::vector<Eigen::Isometry3d>> implied;  // that were tried

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
      const std::vector<double> likeness = features.likeness(scan);
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
    keep_best(is_large() ? features.scores(pairs) : height_maps.scores(pairs), count, others);
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
    height_maps.candidates(all);  // together they share transforms
    std::set<ScanPairs::value_type> chosen;
    for (const std::size_t i : some) {
      std::vector<std::size_t> others;
      std::copy_if(some.begin(), some.end(), std::back_inserter(others),
                   [&](std::size_t j) { return groups[j] != groups[i]; });
      const ScanPairs pairs = pairs_with(i, others);
      std::vector<double> by_maps;
      for (const auto& found : height_maps.candidates(pairs)) by_maps.push_back(best_score(found));
      for (const auto& score : {by_maps, features.scores(pairs)}) {
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
    if (method == Tried::kSlides) return options.slides;
    return options.features || (method != Tried::kFeatures && method != Tried::kDeepFeatures);
  }

  // Inference of a large set costs more than the pairs of the few scans that it left without a place.
  bool all_methods_at_once(const std::vector<bool>& wanted) const {
    return is_large() && std::find(wanted.begin(), wanted.end(), false) != wanted.end();
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

  /// Pairs that were tried by `before` by the method after it; false where that is left out.
  bool try_next(Tried before, const ScanPairs& pairs, bool is_later, HypothesisSet& set) {
    const Tried method = next(before);
    const ScanPairs served = served_by(method, pairs);
    if (!served.empty()) {
      const SearchStage stage = is_deep(method) ? SearchStage::kDeep
                                : is_later      ? SearchStage::kLater
                                                : SearchStage::kFirst;
      fits.fit(served, candidates(before, served, set.fitted_m()), stage, set);
    }
    for (const auto& pair : pairs) tried[pair] = method;
    return !served.empty();
  }

  /// Of many poses that look alike the right one is told by free space: where that tells nothing, more of them are more
  /// that may agree by chance.
  ScanPairs served_by(Tried method, ScanPairs pairs) const {
    if (!uses(method)) return {};
    if (is_deep(method)) {
      std::erase_if(pairs, [&](const auto& pair) {
        return !scans[pair.first].sight.sees_space() || !scans[pair.second].sight.sees_space();
      });
    }
    return pairs;
  }

  /// By the method after `before`.
  /// @param fitted_m  poses nearer than this end at the same fit
  std::vector<std::vector<PoseCandidate>> candidates(Tried before, const ScanPairs& pairs, double fitted_m) {
    switch (before) {
      case Tried::kNothing:
        context.report("comparing height maps", 0, pairs.size());
        return height_maps.candidates(pairs);
      case Tried::kHeightMaps:
        context.report("comparing features", 0, pairs.size());
        return features.candidates(pairs);
      case Tried::kFeatures:
        context.report("comparing along corridors", 0, pairs.size());
        return slides.candidates(pairs);
      case Tried::kSlides:
        context.report("comparing more of height maps", 0, pairs.size());
        return untried(pairs, height_maps.candidates(pairs, kGreatDepth), fitted_m);
      default:
        context.report("comparing more of features", 0, pairs.size());
        return untried(pairs, features.candidates(pairs, kGreatDepth), fitted_m);
    }
  }

  std::vector<std::vector<PoseCandidate>> untried(const ScanPairs& pairs,
                                                  std::vector<std::vector<PoseCandidate>> candidates,
                                                  double distance_m) const {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      candidates[k] = fits.untried(pairs[k].first, pairs[k].second, std::move(candidates[k]), distance_m);
    }
    return candidates;
  }

  /// Fits pairs at given poses where they overlap there; of each scan those with the `most_partners` it overlaps with
  /// most. False where there was none, or all were tried before.
  bool try_poses(const std::vector<ImpliedPose>& poses, CoarseMethod method, std::size_t most_partners,
                 HypothesisSet& set) {
    std::map<ScanPairs::value_type, std::vector<PoseCandidate>> wanted;
    for (const std::size_t k : most_overlapping(poses, overlaps.at(poses, set.same_m()), most_partners)) {
      if (poses[k].agrees) continue;
      const std::size_t a = poses[k].a, b = poses[k].b;
      const Eigen::Isometry3d& T_a_b = poses[k].T_a_b;
      std::vector<Eigen::Isometry3d>& before = implied[{a, b}];
      const bool enough = method == CoarseMethod::kImplied && before.size() >= kMostImplied;
      if (enough || has_within(before, T_a_b, set.fitted_m(), scans[b].moments)) continue;
      before.push_back(T_a_b);
      const bool there = has_within(fits.poses_of(a, b), T_a_b, set.same_m(), scans[b].moments);
      wanted[{a, b}].push_back({T_a_b, method, 1, 1, there});
    }
    ScanPairs pairs;
    std::vector<std::vector<PoseCandidate>> candidates;
    for (auto& [pair, found] : wanted) {
      pairs.push_back(pair);
      candidates.push_back(std::move(found));
    }
    if (!pairs.empty()) fits.fit(pairs, candidates, SearchStage::kFirst, set);
    return !pairs.empty();
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
  const auto candidates = impl_->height_maps.candidates_on(first.grids, first.pairs);
  impl_->context.report("fitting", 0, first.pairs.size());
  impl_->fits.fit_first(first.pairs, candidates);
}

bool PairSearch::may_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
  return impl_->overlaps.may_overlap(a, b, T_a_b);
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
    for (const Tried before : kMethodsBefore) {
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
