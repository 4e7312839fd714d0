#include "links/feature_search.hpp"

#include <cmath>
#include <utility>

#include "core/acceptance.hpp"
#include "core/memory_budget.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

// Each of the two may be off the vertical.
bool tilts(const Eigen::Isometry3d& T) { return T.linear()(2, 2) < std::cos(2 * kMaxLevelTilt_deg * EIGEN_PI / 180); }

}  // namespace

FeatureSearch::FeatureSearch(const std::vector<PreparedScan>& scans, const LinkSearchOptions& options,
                             const RunContext& context, const StepStore* store)
    : scans_(scans), options_(options), context_(context), store_(store) {
  by_first_level_.levels.resize(1);
}

std::vector<std::vector<PoseCandidate>> FeatureSearch::candidates(const ScanPairs& pairs, int depth) {
  FeatureAlignmentOptions by = by_all_levels_;
  by.max_hypotheses *= depth;
  by.max_candidates *= depth;
  const auto key = [&](const PreparedScan& a, const PreparedScan& b) { return feature_key(a, b, options_, depth); };
  Alignments& known = aligned_[depth];
  align(pairs, by, key, known);
  std::vector<std::vector<PoseCandidate>> out;
  for (const auto& pair : pairs) out.push_back(known.at(pair));
  return out;
}

std::vector<double> FeatureSearch::scores(const ScanPairs& pairs) {
  const auto key = [&](const PreparedScan& a, const PreparedScan& b) { return ranking_key(a, b, options_); };
  align(pairs, by_first_level_, key, ranked_);
  std::vector<double> out;
  for (const auto& pair : pairs) out.push_back(best_score(ranked_.at(pair)));
  return out;
}

std::vector<double> FeatureSearch::likeness(std::size_t scan) {
  if (!words_) {
    describe();
    words_.emplace(described_, context_.num_threads);
  }
  return words_->likeness(scan);
}

void FeatureSearch::describe() {
  if (!described_.empty()) return;
  described_.resize(scans_.size());
  parallel_for(context_.num_threads, scans_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Rng rng = make_stream(context_.seed, "features", scans_[i].key);
      described_[i] = in_budget(describe_scan(scans_[i].pyramid, by_all_levels_, rng));
    }
  });
}

// What was not yet.
void FeatureSearch::align(const ScanPairs& pairs, const FeatureAlignmentOptions& by, const MakeKey& key,
                          Alignments& known) {
  describe();
  ScanPairs open;
  for (const auto& pair : pairs) {
    if (!known.contains(pair)) open.push_back(pair);
  }
  std::vector<std::vector<PoseCandidate>> found(open.size());
  parallel_for(context_.num_threads, open.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [a, b] = open[k];
      found[k] = candidates_once(
          store_, [&, a = a, b = b] { return key(scans_[a], scans_[b]); },
          [&, a = a, b = b] { return aligned(a, b, by); });
    }
  });
  for (std::size_t k = 0; k < open.size(); ++k) known.emplace(open[k], std::move(found[k]));
}

std::vector<PoseCandidate> FeatureSearch::aligned(std::size_t a, std::size_t b,
                                                  const FeatureAlignmentOptions& by) const {
  auto found = align_by_features({scans_[a].pyramid, described_[a]}, {scans_[b].pyramid, described_[b]}, by);
  if (options_.level) std::erase_if(found, [](const PoseCandidate& c) { return tilts(c.T_target_source); });
  return found;
}

}  // namespace tcm_icp
