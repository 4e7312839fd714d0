#include "inference/seen_through.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/visibility/free_space.hpp"

namespace tcm_icp {
namespace {

// Points a side has to have looked at for its share to mean anything.
constexpr double kEnoughPoints = 500;
// Of what pairs of right poses see through, standard deviation of the logarithm: one pair proves little.
constexpr double kScatter = 0.6;
constexpr double kUsualQuantile = 0.1;  // of ten storeys that are laid on one another a tenth of all pairs is right
constexpr double kTwinRatio = 4;        // by which twins see through one another more

double share(double violations, double points) { return std::max(violations / points, kUsualViolations); }

}  // namespace

SeenThrough::SeenThrough(const PairGraph& graph, const Component& component) : component_(component) {
  for (const std::size_t k : graph.measured_pairs()) {
    const ComparedPair& pair = graph.pairs()[k];
    if (!component.has(pair.a) || !component.has(pair.b)) continue;
    const PoseHypothesis* there =
        graph.measured_at(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]);
    if (there != nullptr) pairs_.push_back({pair.a, pair.b, there->points_seen, there->points_through});
  }
}

double SeenThrough::excess(const std::vector<bool>& moved) const {
  struct {
    double points = 0, violations = 0, pairs = 0;
  } across, within[2];
  for (const Pair& p : pairs_) {
    auto& sum = moved[p.a] != moved[p.b] ? across : within[moved[p.a] ? 1 : 0];
    sum.points += p.points;
    sum.violations += p.violations;
    ++sum.pairs;
  }
  double excess = 0;
  for (const auto& side : within) {
    if (side.points < kEnoughPoints || across.points < kEnoughPoints) return 0;
    excess = std::max(excess, std::log(share(across.violations, across.points) / share(side.violations, side.points)) -
                                  kScatter * std::sqrt(1 / side.pairs + 1 / across.pairs));
  }
  return excess;
}

std::vector<std::vector<std::size_t>> SeenThrough::parts(double least) const {
  std::vector<double> shares;
  for (const Pair& p : pairs_) {
    if (p.points >= kEnoughPoints) shares.push_back(share(p.violations, p.points));
  }
  if (shares.empty()) return {};
  const double usual = quantile(shares, kUsualQuantile);
  const std::size_t num_scans = component_.T_reference_scan.size(), size = component_.size();
  std::vector<std::vector<std::size_t>> members(num_scans), out;
  for (std::size_t i = 0; i < num_scans; ++i) members[i] = {i};
  // Between parts: logarithm of how much likelier it is to see through as much as usual than through four times as
  // much.
  std::map<std::pair<std::size_t, std::size_t>, double> between;
  for (const Pair& p : pairs_) {
    between[{p.a, p.b}] += p.points * usual * (kTwinRatio - 1) - std::log(kTwinRatio) * p.violations;
  }
  while (!between.empty()) {
    const auto best = std::max_element(between.begin(), between.end(),
                                       [](const auto& x, const auto& y) { return x.second < y.second; });
    const auto [into, from] = best->first;
    members[into].insert(members[into].end(), members[from].begin(), members[from].end());
    between.erase(best);
    for (auto it = between.begin(); it != between.end();) {
      const auto [a, b] = it->first;
      if (a != from && b != from) {
        ++it;
        continue;
      }
      const std::size_t other = a == from ? b : a;
      between[std::minmax(into, other)] += it->second;
      it = between.erase(it);
    }
    if (members[into].size() == size) break;
    std::vector<bool> moved(num_scans, false);
    for (const std::size_t i : members[into]) moved[i] = true;
    if (excess(moved) < least) continue;
    if (moved[component_.reference]) moved.flip();
    std::vector<std::size_t> part;
    for (const std::size_t i : component_.members()) {
      if (moved[i]) part.push_back(i);
    }
    out.push_back(std::move(part));
  }
  return out;
}

}  // namespace tcm_icp
