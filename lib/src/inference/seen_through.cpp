#include "inference/seen_through.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr double kEnoughPoints = 500;  // have to be looked at for a share to mean anything
constexpr double kUsualShare = 0.002;  // of violations, that right poses have where nothing moves
// Of the logarithm of what right scans see through, standard deviation: people about one tell in all its pairs.
constexpr double kScatter = 0.6;
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
    const Looked looked{1, there->points_seen, there->points_through};
    between_[pair.a][pair.b] += looked;
    between_[pair.b][pair.a] += looked;
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
      open.push({promise(looked), std::min(part, other), std::max(part, other), looked.pairs});
    }
  };
  for (std::size_t part = 0; part < part_.size(); ++part) consider(part);
  while (!open.empty()) {
    const Joint joint = open.top();
    open.pop();
    const auto between = between_[joint.into].find(joint.from);
    if (between == between_[joint.into].end() || between->second.pairs != joint.pairs) continue;
    if (between->second.points < kEnoughPoints) continue;
    if (excess_of_parts(joint.into, joint.from) >= kUsualExcess) continue;  // until a part has grown
    join(joint.into, joint.from);
    consider(joint.into);
  }
}

double SeenThrough::promise(const Looked& between) const {
  return between.points * share(usual_) * (kTwinRatio - 1) - std::log(kTwinRatio) * between.violations;
}

double SeenThrough::excess_of_parts(std::size_t part, std::size_t other) const {
  const auto found = between_[part].find(other);
  if (found == between_[part].end() || found->second.points < kEnoughPoints) return 0;
  const Looked& between = found->second;
  const double of_scans = kScatter * kScatter * (1 / size_[part] + 1 / size_[other]);
  const auto beyond = [&](const Looked& within) {
    const double of_counts = 1 / (between.points * share(between)) + 1 / (within.points * share(within));
    return std::max(0.0, std::log(share(between) / share(within)) - std::sqrt(of_scans + of_counts));
  };
  const bool has_one = within_[part].points >= kEnoughPoints, has_two = within_[other].points >= kEnoughPoints;
  if (!has_one && !has_two) return beyond(usual_);
  return std::max(has_one ? beyond(within_[part]) : 0, has_two ? beyond(within_[other]) : 0);
}

void SeenThrough::join(std::size_t into, std::size_t from) {
  size_[into] += size_[from];
  within_[into] += within_[from];
  within_[into] += between_[into][from];
  between_[into].erase(from);
  between_[from].erase(into);
  for (const auto& [other, looked] : between_[from]) {
    between_[into][other] += looked;
    between_[other].erase(from);
    between_[other][into] = between_[into][other];
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
