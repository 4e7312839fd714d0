#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "link_score.hpp"
#include "pose_graph.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

// Loops a link is taken to have beside its own, that close as often as the set's do; and that the set is taken to have,
// all closed.
constexpr double kPriorLoops = 2;
// On real and simulated scenes, hostile ones too, 92 to 100 of 100 loops close; in a corridor of equal rooms 0 to 25.
constexpr double kNoTrust = 0.5, kFullTrust = 0.9;
// Each of the three may be off by as much as one.
constexpr double kClosedWithin = 2;

using Pair = std::pair<std::size_t, std::size_t>;

struct Tally {
  double closed = 0, all = 0;
  double share(double usual) const { return (closed + kPriorLoops * usual) / (all + kPriorLoops); }
};

double trust_of(double share) { return std::clamp((share - kNoTrust) / (kFullTrust - kNoTrust), 0.0, 1.0); }

struct Loop {
  std::array<Pair, 3> links;
  bool closed;
};

std::map<Pair, Tally> count(const std::vector<Loop>& loops) {
  std::map<Pair, Tally> tallies;
  for (const Loop& loop : loops) {
    for (const Pair& pair : loop.links) {
      tallies[pair].closed += loop.closed ? 1 : 0;
      tallies[pair].all += 1;
    }
  }
  return tallies;
}

// The loops of three clear links, each by its likeliest pose.
std::vector<Loop> find_loops(const std::map<Pair, const LinkHypothesis*>& clear, std::size_t num_scans,
                             const std::vector<PointMoments>& points, double same_m) {
  std::vector<Loop> loops;
  for (const auto& [pair, ab] : clear) {
    const auto [a, b] = pair;
    for (std::size_t c = b + 1; c < num_scans; ++c) {
      const auto ac = clear.find({a, c}), bc = clear.find({b, c});
      if (ac == clear.end() || bc == clear.end()) continue;
      const Eigen::Isometry3d around = ac->second->T_a_b.inverse() * ab->T_a_b * bc->second->T_a_b;
      loops.push_back({{pair, ac->first, bc->first}, rms_displacement(around, points[c]) < kClosedWithin * same_m});
    }
  }
  return loops;
}

// Trust of the links that `is_weighed`, by their loops. The worst goes first, with its loops: what it contradicted may
// be right. Some loops of a place that repeats itself close on the wrong pose: no link is trusted more than the set.
template <typename IsWeighed>
void weigh(std::vector<Loop> loops, IsWeighed is_weighed, std::map<Pair, CandidateLink>& links) {
  const auto num_closed =
      static_cast<double>(std::count_if(loops.begin(), loops.end(), [](const Loop& l) { return l.closed; }));
  const double usual = (num_closed + kPriorLoops) / (static_cast<double>(loops.size()) + kPriorLoops);
  std::set<Pair> dropped;
  std::map<Pair, Tally> tallies;
  while (true) {
    tallies = count(loops);
    std::erase_if(tallies, [&](const auto& t) { return !is_weighed(t.first); });
    const auto worst = std::min_element(tallies.begin(), tallies.end(), [&](const auto& x, const auto& y) {
      return x.second.share(usual) < y.second.share(usual);
    });
    if (worst == tallies.end() || worst->second.share(usual) > kNoTrust) break;
    const Pair pair = worst->first;
    dropped.insert(pair);
    std::erase_if(loops, [&](const Loop& l) { return std::count(l.links.begin(), l.links.end(), pair) > 0; });
  }
  for (auto& [pair, link] : links) {
    if (!is_weighed(pair)) continue;
    link.trust = dropped.contains(pair) ? 0 : trust_of(usual) * trust_of(tallies[pair].share(usual));
  }
}

}  // namespace

void PoseGraph::weigh_by_loops(const std::vector<PointMoments>& points, double same_m) {
  // What free space could have vetoed, and did not, has stood a test of its own, and best where it shows no more
  // violations than right poses have. Links that stood a lesser test do not speak against it.
  std::map<Pair, const LinkHypothesis*> borne_out, judged, clear;
  for (const auto& [pair, link] : links_) {
    if (link.hypotheses.empty() || link.hypotheses.front().log_odds < kClearLogOdds) continue;
    const LinkHypothesis& likeliest = link.hypotheses.front();
    clear[pair] = &likeliest;
    if (!likeliest.free_space.tells()) continue;
    judged[pair] = &likeliest;
    if (free_space_log_odds(likeliest.free_space) > kBorneOut) borne_out[pair] = &likeliest;
  }
  std::set<Pair> sure;
  for (const auto* stood : {&borne_out, &judged, &clear}) {
    const bool last = stood == &clear;
    weigh(
        find_loops(*stood, num_scans_, points, same_m),
        [&](const Pair& p) { return !sure.contains(p) && (last || stood->contains(p)); }, links_);
    for (const auto& [pair, hypothesis] : *stood) {
      if (links_.at(pair).trust > 0) sure.insert(pair);
    }
  }
}

}  // namespace tcm_icp
