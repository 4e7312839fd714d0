#include "pair_search.hpp"

#include <algorithm>

#include "link_search.hpp"
#include "tcm_icp/coarse/feature_alignment.hpp"
#include "tcm_icp/coarse/height_correlation.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {

// Height maps first: they are cheap and cover a whole set at once. Local features are asked where those left scans
// alone.
enum class Tried : char { kNothing, kHeightMaps, kBoth };

struct PairSearch::Impl {
  Impl(const std::vector<PreparedScan>& all, const std::vector<std::string>& names, const PipelineOptions& o,
       const RunContext& c)
      : scans(all), files(names), options(o), context(c), tried(all.size() * all.size(), Tried::kNothing) {}

  const std::vector<PreparedScan>& scans;
  const std::vector<std::string>& files;
  const PipelineOptions& options;
  const RunContext& context;
  std::vector<Tried> tried;  // by pair, a * n + b
  FeatureAlignmentOptions features;
  std::vector<DescribedScan> described;  // once they are asked for

  Tried& state(std::size_t a, std::size_t b) { return tried[std::min(a, b) * scans.size() + std::max(a, b)]; }

  /// Target first: the scan whose file comes first by name, so that the order of the files decides nothing.
  ScanPairs pairs(Tried state_wanted, const std::vector<bool>& wanted) {
    ScanPairs out;
    for (std::size_t a = 0; a < scans.size(); ++a) {
      for (std::size_t b = a + 1; b < scans.size(); ++b) {
        if ((wanted[a] || wanted[b]) && state(a, b) == state_wanted) {
          out.push_back(files[a] < files[b] ? std::pair(a, b) : std::pair(b, a));
        }
      }
    }
    return out;
  }

  std::vector<std::vector<PoseCandidate>> by_height_maps(const ScanPairs& pairs) const {
    std::vector<const Cloud*> clouds;
    for (const auto& s : scans) clouds.push_back(&s.fine.cloud);
    std::vector<ScanPair> wanted;
    for (const auto& [a, b] : pairs) wanted.push_back({a, b});
    return correlate_height_maps(clouds, wanted, {}, context.num_threads);
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
      }
    });
    return out;
  }

  void fit(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates, PoseGraph& graph) const {
    std::vector<CandidateLink> links(pairs.size());
    parallel_for(context.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        links[k] = fit_candidates(scans, pairs[k].first, pairs[k].second, candidates[k], options);
      }
    });
    for (auto& link : links) {
      if (link.a > link.b) link.swap();
      const PreparedScan& b = scans[link.b];
      graph.add(link, b.held_out_sample.points, b.pyramid.level(0).voxel_size_m);
    }
  }
};

PairSearch::PairSearch(const std::vector<PreparedScan>& scans, const std::vector<std::string>& files,
                       const PipelineOptions& options, const RunContext& context)
    : impl_(new Impl(scans, files, options, context)) {}
PairSearch::~PairSearch() = default;

void PairSearch::leave_out(std::size_t a, std::size_t b) { impl_->state(a, b) = Tried::kBoth; }

void PairSearch::run(PoseGraph& graph) {
  std::vector<bool> wanted(impl_->scans.size(), true);
  // More is asked where links leave scans apart.
  while (std::find(wanted.begin(), wanted.end(), true) != wanted.end() && extend(graph, wanted)) {
    wanted = graph.outside_of_largest_group();
  }
}

bool PairSearch::extend(PoseGraph& graph, const std::vector<bool>& wanted) {
  if (const ScanPairs pairs = impl_->pairs(Tried::kNothing, wanted); !pairs.empty()) {
    impl_->context.report("comparing height maps", 0, pairs.size());
    impl_->fit(pairs, impl_->by_height_maps(pairs), graph);
    for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kHeightMaps;
    return true;
  }
  if (const ScanPairs pairs = impl_->pairs(Tried::kHeightMaps, wanted); !pairs.empty()) {
    impl_->context.report("comparing features", 0, pairs.size());
    impl_->fit(pairs, impl_->by_features(pairs), graph);
    for (const auto& [a, b] : pairs) impl_->state(a, b) = Tried::kBoth;
    return true;
  }
  return false;
}

}  // namespace tcm_icp
