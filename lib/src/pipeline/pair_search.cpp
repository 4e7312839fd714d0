#include "pair_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "link_search.hpp"
#include "tcm_icp/coarse/feature_alignment.hpp"
#include "tcm_icp/coarse/height_correlation.hpp"
#include "tcm_icp/coarse/slide_search.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

// Height maps first: they are cheap and cover a whole set at once. Local features are asked where those left scans
// alone, and then slides, which need poses to start from.

// A scan overlaps few others much. Where there are more, all pairs are ranked at little cost first.
constexpr std::size_t kFirstPartners = 10;
constexpr std::size_t kSlidesOfPose = 8;  // from one pose

// Each of the two may be off the vertical.
bool tilts(const Eigen::Isometry3d& T) { return T.linear()(2, 2) < std::cos(2 * kMaxLevelTilt_deg * EIGEN_PI / 180); }

Cloud surfaces(const PreparedScan& scan, NormalSides sides) {
  const Cloud& cloud = scan.pyramid.level(0).cloud;
  return sides == NormalSides::kSeen ? Cloud{cloud.points, scan.sight.facing} : cloud;
}

enum class Tried : char { kNothing, kHeightMaps, kFeatures, kSlides };

}  // namespace

struct PairSearch::Impl {
  Impl(const std::vector<PreparedScan>& all, const std::vector<std::string>& names, const PipelineOptions& o,
       const RunContext& c)
      : scans(all), files(names), options(o), context(c), tried(all.size() * all.size(), Tried::kNothing) {}

  const std::vector<PreparedScan>& scans;
  const std::vector<std::string>& files;
  const PipelineOptions& options;
  const RunContext& context;
  std::vector<Tried> tried;  // by pair, a * n + b
  std::vector<std::vector<std::size_t>> partners;
  std::vector<std::size_t> reach;  // how many of them were asked for, of each scan
  FeatureAlignmentOptions features;
  std::vector<DescribedScan> described;                                                  // once they are asked for
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Eigen::Isometry3d>> fitted;  // target and source

  Tried& state(std::size_t a, std::size_t b) { return tried[std::min(a, b) * scans.size() + std::max(a, b)]; }

  /// The pair, the scan whose file comes first by name as the target, so that the order of the files decides nothing.
  std::pair<std::size_t, std::size_t> ordered(std::size_t a, std::size_t b) const {
    return files[a] < files[b] ? std::pair(a, b) : std::pair(b, a);
  }

  /// Pairs of the state wanted, of each wanted scan with its likeliest partners.
  ScanPairs pairs(Tried state_wanted, const std::vector<bool>& wanted) {
    std::vector<bool> chosen(scans.size() * scans.size(), false);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!wanted[i]) continue;
      for (std::size_t k = 0; k < std::min(reach[i], partners[i].size()); ++k) {
        const std::size_t j = partners[i][k];
        chosen[std::min(i, j) * scans.size() + std::max(i, j)] = true;
      }
    }
    ScanPairs out;
    for (std::size_t a = 0; a < scans.size(); ++a) {
      for (std::size_t b = a + 1; b < scans.size(); ++b) {
        if (chosen[a * scans.size() + b] && state(a, b) == state_wanted) out.push_back(ordered(a, b));
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
    std::vector<double> score(n * n, 0.0);
    if (n > kFirstPartners + 1) {
      context.report("ranking pairs", 0, n * (n - 1) / 2);
      std::vector<const Cloud*> clouds;
      for (const auto& s : scans) clouds.push_back(&s.fine.cloud);
      std::vector<ScanPair> all;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = a + 1; b < n; ++b) {
          const auto [target, source] = ordered(a, b);
          all.push_back({target, source});
        }
      }
      HeightCorrelationOptions screening = screening_options();
      screening.vertical.levelled = options.level;
      const auto scores = screen_by_height_maps(clouds, all, screening, context.num_threads);
      for (std::size_t k = 0; k < all.size(); ++k) {
        score[all[k].target * n + all[k].source] = score[all[k].source * n + all[k].target] = scores[k];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (j != i) partners[i].push_back(j);
      }
      std::stable_sort(partners[i].begin(), partners[i].end(), [&](std::size_t x, std::size_t y) {
        const double a = score[i * n + x], b = score[i * n + y];
        return a != b ? a > b : files[x] < files[y];
      });
    }
  }

  /// Twice as many partners for the wanted scans; false where they had all.
  bool reach_further(const std::vector<bool>& wanted) {
    bool more = false;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!wanted[i] || reach[i] >= partners[i].size()) continue;
      reach[i] *= 2;
      more = true;
    }
    return more;
  }

  std::vector<std::vector<PoseCandidate>> by_height_maps(const ScanPairs& pairs) const {
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
      wanted.push_back({place[a], place[b]});
    }
    HeightCorrelationOptions correlation;
    correlation.vertical.levelled = options.level;
    return correlate_height_maps(clouds, wanted, correlation, context.num_threads);
  }

  void describe() {
    if (!described.empty()) return;
    described.resize(scans.size());
    parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Rng rng = make_stream(context.seed, "features", files[i]);
        described[i] = describe_scan(scans[i].pyramid, features, rng);
      }
    });
  }

  std::vector<std::vector<PoseCandidate>> by_features(const ScanPairs& pairs) {
    describe();
    std::vector<std::vector<PoseCandidate>> out(pairs.size());
    parallel_for(context.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto [a, b] = pairs[k];
        out[k] = align_by_features({scans[a].pyramid, described[a]}, {scans[b].pyramid, described[b]}, features);
        if (options.level) std::erase_if(out[k], [](const PoseCandidate& c) { return tilts(c.T_target_source); });
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
        const bool seen = scans[a].sight.knows_sides() && scans[b].sight.knows_sides();
        const NormalSides sides = seen ? NormalSides::kSeen : NormalSides::kUnknown;
        const Cloud target = surfaces(scans[a], sides), source = surfaces(scans[b], sides);
        const double voxel_m = scans[a].pyramid.level(0).voxel_size_m;
        for (const Eigen::Isometry3d& T : known->second) {
          const auto slid = slide_candidates(target, source, T, voxel_m, sides, kSlidesOfPose);
          out[k].insert(out[k].end(), slid.begin(), slid.end());
        }
      }
    });
    return out;
  }

  void fit(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates, PoseGraph& graph) {
    std::vector<CandidateLink> links(pairs.size());
    parallel_for(context.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        links[k] = fit_candidates(scans, pairs[k].first, pairs[k].second, candidates[k], options);
      }
    });
    for (auto& link : links) {
      // As fitted: taken back and forth, a pose would not have the same last digits.
      for (const auto& h : link.hypotheses) fitted[{link.a, link.b}].push_back(h.T_a_b);
      if (link.a > link.b) link.swap();
      const PreparedScan& b = scans[link.b];
      graph.add(link, b.moments, b.pyramid.level(0).voxel_size_m);
    }
  }
};

PairSearch::PairSearch(const std::vector<PreparedScan>& scans, const std::vector<std::string>& files,
                       const PipelineOptions& options, const RunContext& context)
    : impl_(new Impl(scans, files, options, context)) {}
PairSearch::~PairSearch() = default;

void PairSearch::leave_out(std::size_t a, std::size_t b) { impl_->state(a, b) = Tried::kSlides; }

void PairSearch::run(PoseGraph& graph) {
  std::vector<bool> wanted(impl_->scans.size(), true);
  // More is asked where links leave scans apart.
  while (std::find(wanted.begin(), wanted.end(), true) != wanted.end() && extend(graph, wanted)) {
    wanted = graph.outside_of_largest_group();
  }
}

bool PairSearch::extend(PoseGraph& graph, const std::vector<bool>& wanted) {
  impl_->rank_partners();
  do {
    if (const ScanPairs pairs = impl_->pairs(Tried::kNothing, wanted); !pairs.empty()) {
      impl_->context.report("comparing height maps", 0, pairs.size());
      impl_->fit(pairs, impl_->by_height_maps(pairs), graph);
      for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kHeightMaps;
      return true;
    }
    if (const ScanPairs pairs = impl_->pairs(Tried::kHeightMaps, wanted); !pairs.empty()) {
      impl_->context.report("comparing features", 0, pairs.size());
      impl_->fit(pairs, impl_->by_features(pairs), graph);
      for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kFeatures;
      return true;
    }
    if (const ScanPairs pairs = impl_->pairs(Tried::kFeatures, wanted); !pairs.empty()) {
      impl_->context.report("comparing along corridors", 0, pairs.size());
      impl_->fit(pairs, impl_->by_slides(pairs), graph);
      for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kSlides;
      return true;
    }
  } while (impl_->reach_further(wanted));
  return false;
}

}  // namespace tcm_icp
