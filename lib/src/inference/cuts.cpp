#include "inference/cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "inference/minimum_cuts.hpp"
#include "inference/pairs_across.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

std::vector<WeightedEdge> supported_pairs(const PairGraph& graph, const Component& component, const AlikeParts& alike) {
  std::vector<WeightedEdge> edges;
  for (const ComparedPair& pair : graph.pairs()) {
    if (!component.has(pair.a) || !component.has(pair.b)) continue;
    const double support =
        graph.support(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]) -
        alike.less_said(pair.a, pair.b);
    if (support > 0) edges.push_back({support, pair.a, pair.b});
  }
  return edges;
}

void sort_without_repeats(std::vector<std::vector<std::size_t>>& parts) {
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
}

Cut cut_of(const PairsAcross& across, std::vector<std::size_t> moved, double most_lead) {
  const double support = across.support(Eigen::Isometry3d::Identity());
  const auto elsewhere = across.best_elsewhere(std::max(0.0, support - most_lead));
  const double odds = across.odds_elsewhere(elsewhere.motion);
  return {std::move(moved), support, elsewhere.motion ? elsewhere.support : 0, elsewhere.motion, odds};
}

}  // namespace

double Cut::lead() const {
  const double others = std::exp(-other_support) * (1 + odds_elsewhere) + (other_motion ? 1 : 0);
  return support - other_support - std::log(others);
}

Cut measure_cut(const PairGraph& graph, const Component& component, std::vector<std::size_t> moved, double most_lead) {
  const PairsAcross across(graph, component, AlikeParts(graph, component), moved);
  return cut_of(across, std::move(moved), most_lead);
}

const Cut* weakest_cut_of(std::size_t scan, const std::vector<Cut>& cuts) {
  const Cut* weakest = nullptr;
  for (const Cut& cut : cuts) {
    if (cut.moves(scan) && (weakest == nullptr || cut.lead() < weakest->lead())) weakest = &cut;
  }
  return weakest;
}

std::vector<std::size_t> frontier(const PairGraph& graph, const Component& component, const Cut& cut) {
  const auto& T = component.T_reference_scan;
  std::vector<std::size_t> out;
  for (const std::size_t i : cut.moved) {
    const auto& pairs = graph.pairs_of(i);
    const bool holds = std::any_of(pairs.begin(), pairs.end(), [&](std::size_t k) {
      const ComparedPair& pair = graph.pairs()[k];
      const std::size_t other = pair.a == i ? pair.b : pair.a;
      return component.has(other) && !cut.moves(other) && graph.support(pair, *T[pair.a], *T[pair.b]) > 0;
    });
    if (holds) out.push_back(i);
  }
  return out.empty() ? cut.moved : out;
}

std::vector<std::size_t> clear_groups(const std::vector<Component>& components,
                                      const std::vector<std::vector<Cut>>& cuts, double clear_lead,
                                      std::size_t num_scans) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> group(num_scans, kNone);
  std::size_t num_groups = 0;
  for (std::size_t c = 0; c < components.size(); ++c) {
    std::map<std::vector<bool>, std::size_t> of_sides;  // which side of each weak cut
    for (const std::size_t i : components[c].members()) {
      std::vector<bool> sides;
      for (const Cut& cut : cuts[c]) {
        if (cut.lead() < clear_lead) sides.push_back(cut.moves(i));
      }
      const auto [known, is_new] = of_sides.try_emplace(std::move(sides), num_groups);
      if (is_new) ++num_groups;
      group[i] = known->second;
    }
  }
  for (std::size_t& g : group) {
    if (g == kNone) g = num_groups++;
  }
  return group;
}

Leads::Leads(const std::vector<Cut>& cuts, std::size_t num_scans) {
  for (const Cut& cut : cuts) {
    std::vector<bool> moves(num_scans, false);
    for (const std::size_t i : cut.moved) moves[i] = true;
    sides_.push_back({cut.lead(), std::move(moves)});
  }
  std::stable_sort(sides_.begin(), sides_.end(), [](const Sides& x, const Sides& y) { return x.lead < y.lead; });
}

double Leads::between(std::size_t a, std::size_t b) const {
  for (const Sides& s : sides_) {
    if (s.moves[a] != s.moves[b]) return s.lead;
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<std::vector<std::size_t>> weakest_parts(const PairGraph& graph, const Component& component,
                                                    const AlikeParts& alike) {
  auto parts = minimum_cuts(supported_pairs(graph, component, alike), component.members(), component.reference);
  sort_without_repeats(parts);
  return parts;
}

std::vector<Cut> weakest_cuts(const PairGraph& graph, const Component& component, int num_threads, double most_lead) {
  const AlikeParts alike(graph, component);
  auto parts = weakest_parts(graph, component, alike);
  for (const std::size_t i : component.members()) {
    if (i != component.reference) parts.push_back({i});
  }
  const auto storeys = alike.parts();
  parts.insert(parts.end(), storeys.begin(), storeys.end());
  sort_without_repeats(parts);
  std::vector<Cut> cuts(parts.size());
  parallel_for(num_threads, parts.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const PairsAcross across(graph, component, alike, parts[k]);
      cuts[k] = cut_of(across, std::move(parts[k]), most_lead);
    }
  });
  return cuts;
}

}  // namespace tcm_icp
