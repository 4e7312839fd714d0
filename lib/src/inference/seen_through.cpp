#include "inference/seen_through.hpp"

#include <algorithm>
#include <cmath>

#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr double kEnoughPoints = 500;   // have to be looked at for a share to mean anything, half of them either way
constexpr double kUsualShare = 0.0015;  // of violations, that right poses have where nothing moves
constexpr double kFullOverlap = 0.5;    // what moves is about the scanners: what shares less sees less of it
// Of the logarithm of what right scans see through, standard deviation: people about one tell in all its pairs.
constexpr double kScatter = 0.4;
constexpr double kUsualQuantile = 0.1;  // of ten storeys that are laid on one another a tenth of all pairs is right
constexpr double kTwinRatio = 4;        // by which twins see through one another more

}  // namespace

SeenThrough::Looked& SeenThrough::Looked::operator+=(const Looked& other) {
  pairs += other.pairs;
  points += other.points;
  violations += other.violations;
  large += other.large;
  return *this;
}

double SeenThrough::share(const Looked& looked) { return std::max(looked.violations / looked.points, kUsualShare); }

double SeenThrough::share_between(const Looked& looked) { return std::max(looked.large / looked.points, kUsualShare); }

SeenThrough::Looked SeenThrough::looked_at(const LookedAt& points, double overlap) {
  return {1, static_cast<double>(points.points) * std::min(1.0, overlap / kFullOverlap),
          static_cast<double>(points.violations), static_cast<double>(points.large)};
}

SeenThrough::SeenThrough(const PairGraph& graph, const Component& component)
    : component_(component), parts_(component.T_reference_scan.size()) {
  std::vector<double> shares;
  graph.for_measured(component, [&](const ComparedPair& pair, const PoseHypothesis& there) {
    parts_.add(pair.a, pair.b, looked_at(there.of_a, there.overlap), looked_at(there.of_b, there.overlap));
    const Looked looked = parts_.both_sides(pair.a, pair.b);
    if (looked.points >= kEnoughPoints) shares.push_back(share(looked));
  });
  if (shares.empty()) return;
  usual_.points = kEnoughPoints;
  usual_.violations = kEnoughPoints * quantile(shares, kUsualQuantile);
  parts_.join([&](const Looked& between) { return promise(between); },
              [&](std::size_t part, std::size_t other) {
                return parts_.both_sides(part, other).points >= kEnoughPoints &&
                       excess_of_parts(part, other) < kUsualExcess;
              });
}

double SeenThrough::promise(const Looked& between) const {
  return between.points * share(usual_) * (kTwinRatio - 1) - std::log(kTwinRatio) * between.large;
}

bool SeenThrough::tells_within(std::size_t part) const { return parts_.within(part).points >= kEnoughPoints; }

double SeenThrough::excess_of_parts(std::size_t part, std::size_t other) const {
  if (!parts_.has_between(part, other)) return 0;
  if (std::min(parts_.of(part, other).points, parts_.of(other, part).points) < kEnoughPoints / 2) return 0;
  return std::min(excess_one_way(part, other), excess_one_way(other, part));
}

double SeenThrough::excess_one_way(std::size_t part, std::size_t other) const {
  const Looked& between = parts_.of(part, other);
  const Looked& within = tells_within(part) ? parts_.within(part) : tells_within(other) ? parts_.within(other) : usual_;
  const double of_scans = kScatter * kScatter * (1 / parts_.size(part) + 1 / parts_.size(other));
  const double of_counts = 1 / (between.points * share_between(between)) + 1 / (within.points * share(within));
  return std::max(0.0, std::log(share_between(between) / share(within)) - std::sqrt(of_scans + of_counts));
}

double SeenThrough::excess(std::size_t a, std::size_t b) const {
  return excess_of_parts(parts_.part_of(a), parts_.part_of(b));
}

double SeenThrough::twins(std::size_t a, std::size_t b) const {
  return std::clamp((excess(a, b) - kUsualExcess) / (kTwinExcess - kUsualExcess), 0.0, 1.0);
}

std::vector<std::vector<std::size_t>> SeenThrough::parts() const {
  return parts_.parts(component_.members(), component_.reference, [&](std::size_t part, std::size_t other) {
    return excess_of_parts(part, other) >= kUsualExcess;
  });
}

}  // namespace tcm_icp
