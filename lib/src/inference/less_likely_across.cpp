#include "inference/less_likely_across.hpp"

#include <algorithm>
#include <cmath>

#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// Log-odds of right pairs that are measured where they lie, of simulated and real sets: about kOfNone where they hardly
// overlap, and kOfAll more where they share all. What is far from that is no farther.
constexpr double kOfNone = 2.5, kOfAll = 5;
constexpr double kLeastLogOdds = -4, kMostBeyond = 1;
constexpr double kTellingOverlap = 0.5;  // pairs that share less tell less
constexpr double kEnoughWeight = 0.5;
constexpr double kTwinShare = 0.6;  // of usual weights: twins lie on one another, so that their pairs share as much
constexpr double kUpperQuartile = 0.75;  // of two storeys that are laid on one another half of all pairs are right
constexpr double kMidway = 1.75;         // between pairs of one part and of twins
// Standard deviations of right pairs: what all pairs of a scan have in common, such as people about it, and a pair's.
constexpr double kScanScatter = 1.5, kPairScatter = 2;
constexpr double kUsualDeficit = 1.25, kTwinDeficit = 1.75;

}  // namespace

LessLikelyAcross::Shown& LessLikelyAcross::Shown::operator+=(const Shown& other) {
  pairs += other.pairs;
  weight += other.weight;
  sum += other.sum;
  return *this;
}

LessLikelyAcross::LessLikelyAcross(const PairGraph& graph, const Component& component)
    : component_(component), parts_(component.T_reference_scan.size()) {
  std::vector<double> shown, weights;
  graph.for_measured(component, [&](const ComparedPair& pair, const PoseHypothesis& there) {
    const double beyond = std::max(there.log_odds, kLeastLogOdds) - (kOfNone + kOfAll * there.overlap);
    shown.push_back(std::min(beyond, kMostBeyond));
    weights.push_back(std::min(1.0, there.overlap / kTellingOverlap));
    parts_.add(pair.a, pair.b, {1, weights.back(), weights.back() * shown.back()}, {});
  });
  if (shown.empty()) return;
  usual_ = quantile(shown, kUpperQuartile);
  usual_weight_ = quantile(weights, kUpperQuartile);
  parts_.join([&](const Shown& between) { return between.sum - between.weight * (usual_ - kMidway); },
              [&](std::size_t part, std::size_t other) { return deficit_of_parts(part, other) < kUsualDeficit; });
}

double LessLikelyAcross::deficit_of_parts(std::size_t part, std::size_t other) const {
  if (!parts_.has_between(part, other)) return 0;
  const Shown between = parts_.both_sides(part, other);
  if (between.weight < kEnoughWeight || between.weight < kTwinShare * usual_weight_ * between.pairs) return 0;
  Shown within{1, 1, usual_};  // one pair's worth, for parts that have none of their own
  within += parts_.within(part);
  within += parts_.within(other);
  const double of_scans = kScanScatter * kScanScatter * (1 / parts_.size(part) + 1 / parts_.size(other));
  const double of_pairs = kPairScatter * kPairScatter * (1 / between.weight + 1 / within.weight);
  return within.sum / within.weight - between.sum / between.weight - std::sqrt(of_scans + of_pairs);
}

double LessLikelyAcross::deficit(std::size_t a, std::size_t b) const {
  const auto [part, other] = std::minmax({parts_.part_of(a), parts_.part_of(b)});  // sums are of one order
  return part == other ? 0 : deficit_of_parts(part, other);
}

double LessLikelyAcross::twins(std::size_t a, std::size_t b) const {
  return std::clamp((deficit(a, b) - kUsualDeficit) / (kTwinDeficit - kUsualDeficit), 0.0, 1.0);
}

std::vector<std::vector<std::size_t>> LessLikelyAcross::parts() const {
  return parts_.parts(component_.members(), component_.reference, [&](std::size_t part, std::size_t other) {
    return deficit_of_parts(part, other) >= kUsualDeficit;
  });
}

}  // namespace tcm_icp
