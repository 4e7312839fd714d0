#include "inference/seen_through.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

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

// Two parts that may be joined, as they were.
struct Joint {
  double promise;
  std::size_t into, from;
  double pairs;  // between them: with every join either has more

  // Of two that promise the same the earlier parts go first: no accident decides.
  bool operator<(const Joint& other) const {
    if (promise != other.promise) return promise < other.promise;
    return into != other.into ? into > other.into : from > other.from;
  }
};

}  // namespace

SeenThrough::Looked& SeenThrough::Looked::operator+=(const Looked& other) {
  pairs += other.pairs;
  points += other.points;
  violations += other.violations;
  return *this;
}

double SeenThrough::share(const Looked& looked) { return std::max(looked.violations / looked.points, kUsualShare); }

SeenThrough::Looked SeenThrough::looked_at(const LookedAt& points, double overlap) {
  return {1, static_cast<double>(points.points) * std::min(1.0, overlap / kFullOverlap),
          static_cast<double>(points.violations)};
}

SeenThrough::Looked SeenThrough::both_ways(std::size_t part, std::size_t other) const {
  Looked out = between_[part].at(other);
  out += between_[other].at(part);
  return out;
}

SeenThrough::SeenThrough(const PairGraph& graph, const Component& component)
    : component_(component),
      log_alike_(graph.options().log_alike),
      part_(component.T_reference_scan.size()),
      size_(part_.size(), 1),
      within_(part_.size()),
      between_(part_.size()) {
  std::iota(part_.begin(), part_.end(), std::size_t{0});
  std::vector<double> shares;
  for (const std::size_t k : graph.measured_pairs()) {
    const ComparedPair& pair = graph.pairs()[k];
    if (!component.has(pair.a) || !component.has(pair.b)) continue;
    const PoseHypothesis* there =
        graph.measured_at(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]);
    if (there == nullptr) continue;
    between_[pair.a][pair.b] += looked_at(there->of_a, there->overlap);
    between_[pair.b][pair.a] += looked_at(there->of_b, there->overlap);
    const Looked looked = both_ways(pair.a, pair.b);
    if (looked.points >= kEnoughPoints) shares.push_back(share(looked));
  }
  if (shares.empty()) return;
  usual_.points = kEnoughPoints;
  usual_.violations = kEnoughPoints * quantile(shares, kUsualQuantile);
  join_parts();
}

void SeenThrough::join_parts() {
  std::priority_queue<Joint> open;
  const auto consider = [&](std::size_t part) {
    for (const auto& [other, looked] : between_[part]) {
      open.push({promise(both_ways(part, other)), std::min(part, other), std::max(part, other), looked.pairs});
    }
  };
  for (std::size_t part = 0; part < part_.size(); ++part) consider(part);
  while (!open.empty()) {
    const Joint joint = open.top();
    open.pop();
    const auto between = between_[joint.into].find(joint.from);
    if (between == between_[joint.into].end() || between->second.pairs != joint.pairs) continue;
    if (both_ways(joint.into, joint.from).points < kEnoughPoints) continue;
    if (excess_of_parts(joint.into, joint.from) >= kUsualExcess) continue;  // until a part has grown
    join(joint.into, joint.from);
    consider(joint.into);
  }
}

double SeenThrough::promise(const Looked& between) const {
  return between.points * share(usual_) * (kTwinRatio - 1) - std::log(kTwinRatio) * between.violations;
}

bool SeenThrough::tells_within(std::size_t part) const { return within_[part].points >= kEnoughPoints; }

double SeenThrough::excess_of_parts(std::size_t part, std::size_t other) const {
  const auto found = between_[part].find(other);
  if (found == between_[part].end()) return 0;
  if (std::min(found->second.points, between_[other].at(part).points) < kEnoughPoints / 2) return 0;
  return std::min(excess_one_way(part, other), excess_one_way(other, part));
}

double SeenThrough::excess_one_way(std::size_t part, std::size_t other) const {
  const Looked& between = between_[part].at(other);
  const Looked& within = tells_within(part) ? within_[part] : tells_within(other) ? within_[other] : usual_;
  const double of_scans = kScatter * kScatter * (1 / size_[part] + 1 / size_[other]);
  const double of_counts = 1 / (between.points * share(between)) + 1 / (within.points * share(within));
  return std::max(0.0, std::log(share(between) / share(within)) - std::sqrt(of_scans + of_counts));
}

void SeenThrough::join(std::size_t into, std::size_t from) {
  size_[into] += size_[from];
  within_[into] += within_[from];
  within_[into] += both_ways(into, from);
  between_[into].erase(from);
  between_[from].erase(into);
  for (const auto& [other, looked] : between_[from]) {
    between_[into][other] += looked;
    between_[other][into] += between_[other][from];
    between_[other].erase(from);
  }
  between_[from].clear();
  std::replace(part_.begin(), part_.end(), from, into);
}

double SeenThrough::excess(std::size_t a, std::size_t b) const { return excess_of_parts(part_[a], part_[b]); }

bool SeenThrough::is_seen_through(std::size_t part) const {
  return std::any_of(between_[part].begin(), between_[part].end(),
                     [&](const auto& other) { return excess_of_parts(part, other.first) >= kUsualExcess; });
}

double SeenThrough::less_said(std::size_t a, std::size_t b) const {
  return log_alike_ * std::clamp((excess(a, b) - kUsualExcess) / (kTwinExcess - kUsualExcess), 0.0, 1.0);
}

std::vector<std::vector<std::size_t>> SeenThrough::parts() const {
  const std::size_t of_reference = part_[component_.reference];
  std::map<std::size_t, std::vector<std::size_t>> parts;
  for (const std::size_t i : component_.members()) {
    if (part_[i] == of_reference) continue;
    parts[part_[i]].push_back(i);
    parts[of_reference].push_back(i);
  }
  std::vector<std::vector<std::size_t>> out;
  for (auto& [part, scans] : parts) {
    if (is_seen_through(part)) out.push_back(std::move(scans));
  }
  return out;
}

}  // namespace tcm_icp
