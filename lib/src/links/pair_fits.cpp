#include "links/pair_fits.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/acceptance.hpp"
#include "links/pair_steps.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

// Of a pair and method, beside those that free space vetoes; a clear hypothesis ends them.
constexpr int kMaxFits = 3;

}  // namespace

PairFits::PairFits(const std::vector<PreparedScan>& scans, const LinkSearchOptions& options, const RunContext& context,
                   const StepStore* store)
    : scans_(scans), options_(options), context_(context), store_(store) {}

void PairFits::fit(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates, SearchStage stage,
                   HypothesisSet& set) {
  std::vector<std::vector<PoseCandidate>> queues(pairs.size());
  parallel_for(context_.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      queues[k] = in_order_of_promise(scans_[pairs[k].first], scans_[pairs[k].second], candidates[k]);
      std::reverse(queues[k].begin(), queues[k].end());
    }
  });
  for (const auto& [a, b] : pairs) set.add(a, b, {});
  std::vector<std::size_t> open(pairs.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  std::vector<int> num_fits(pairs.size(), 0);
  std::vector<std::vector<Eigen::Isometry3d>> tried(pairs.size());
  while (!open.empty()) {
    std::vector<std::optional<LinkHypothesis>> found(open.size());
    parallel_for(context_.num_threads, open.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto [a, b] = pairs[open[i]];
        std::vector<PoseCandidate>& queue = queues[open[i]];
        while (!queue.empty() && !found[i]) {
          found[i] = fit_candidate_once(store_, scans_[a], scans_[b], queue.back(), options_);
          tried[open[i]].push_back(queue.back().T_target_source);
          queue.pop_back();
        }
      }
    });
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (!found[i]) continue;
      const auto [a, b] = pairs[open[i]];
      found[i]->stage = stage;
      fitted_[{a, b}].push_back(found[i]->T_a_b);
      if (!found[i]->measurements.free_space.vetoes()) ++num_fits[open[i]];
      set.add(a, b, {*found[i]});
    }
    set.score();
    std::erase_if(open, [&](std::size_t k) {
      return queues[k].empty() || num_fits[k] == kMaxFits ||
             set.log_odds(pairs[k].first, pairs[k].second) >= kClearLogOdds;
    });
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    auto& known = tried_[pairs[k]];
    known.insert(known.end(), tried[k].begin(), tried[k].end());
  }
  if (stage == SearchStage::kDeep) set.drop_unlikely_deep();
}

std::vector<PoseCandidate> PairFits::untried(std::size_t a, std::size_t b, std::vector<PoseCandidate> candidates,
                                             double distance_m) const {
  const auto known = tried_.find({a, b});
  if (known == tried_.end()) return candidates;
  std::erase_if(candidates, [&](const PoseCandidate& candidate) {
    return has_within(known->second, candidate.T_target_source, distance_m, scans_[b].moments);
  });
  return candidates;
}

void PairFits::fit_first(const ScanPairs& pairs, const std::vector<std::vector<PoseCandidate>>& candidates) const {
  parallel_for(context_.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const PreparedScan &a = scans_[pairs[k].first], &b = scans_[pairs[k].second];
      for (const PoseCandidate& candidate : in_order_of_promise(a, b, candidates[k])) {
        if (fit_candidate_once(store_, a, b, candidate, options_)) break;
      }
    }
  });
}

const std::vector<Eigen::Isometry3d>& PairFits::poses_of(std::size_t a, std::size_t b) const {
  static const std::vector<Eigen::Isometry3d> none;
  const auto known = fitted_.find({a, b});
  return known != fitted_.end() ? known->second : none;
}

}  // namespace tcm_icp
