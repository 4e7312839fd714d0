#include "inference/configuration.hpp"

#include <algorithm>
#include <optional>

#include "inference/cuts.hpp"
#include "inference/pairs_across.hpp"
#include "inference/places.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

constexpr double kLeastAverage = 0.01;  // in log-likelihood; what less moves is left to the adjustment

struct Start {
  double log_odds;
  const ComparedPair* pair;
  const PoseHypothesis* hypothesis;
};

// Scan by scan, the best supported next.
void grow(const PairGraph& graph, const std::vector<bool>& open, Component& component) {
  const std::size_t n = graph.num_scans();
  std::vector<std::optional<Places>> places(n);
  std::vector<std::optional<Place>> best(n);
  const auto look_around = [&](std::size_t scan) {
    for (const std::size_t k : graph.pairs_of(scan)) {
      const ComparedPair& pair = graph.pairs()[k];
      const std::size_t other = pair.a == scan ? pair.b : pair.a;
      if (!open[other] || component.has(other)) continue;
      places[other]->add(pair, component);
      best[other] = places[other]->best(component);
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (!open[i] || component.has(i)) continue;
    places[i] = Places::beside(graph, i, component);
    best[i] = places[i]->best(component);
  }
  while (true) {
    std::optional<std::size_t> next;
    for (std::size_t i = 0; i < n; ++i) {
      if (component.has(i) || !best[i] || best[i]->support <= 0) continue;
      if (!next || best[i]->support > best[*next]->support + kLeastGain) next = i;
    }
    if (!next) return;
    component.T_reference_scan[*next] = best[*next]->T;
    look_around(*next);
  }
}

// Single scans to where the others support them most, or out. True where one is at a clearly different place.
bool move_scans(const PairGraph& graph, Component& component) {
  bool moved = false;
  for (const std::size_t i : component.members()) {
    if (i == component.reference) continue;
    const Eigen::Isometry3d T = *component.T_reference_scan[i];
    component.T_reference_scan[i].reset();
    const double here = graph.support_of(i, T, component);
    const std::optional<Place> best = Places::beside(graph, i, component).best(component);
    if (best && best->support > std::max(0.0, here) + kLeastGain) {
      component.T_reference_scan[i] = best->T;
      moved = moved || !graph.same_pose(i, T, best->T);
    } else if (here > 0) {
      component.T_reference_scan[i] = T;
    } else {
      moved = true;  // out
    }
  }
  return moved;
}

// To the mean of what agrees: chains of hypotheses add their errors up, and what lies off supports less. What the
// likelihood gains.
double average_poses(const PairGraph& graph, Component& component) {
  double gain = 0;
  for (const std::size_t i : component.members()) {
    if (i == component.reference) continue;
    const Eigen::Isometry3d T = *component.T_reference_scan[i], mean = graph.mean_pose(i, T, component);
    const double more = graph.support_of(i, mean, component) - graph.support_of(i, T, component);
    if (more <= kLeastGain) continue;
    component.T_reference_scan[i] = mean;
    gain += more;
  }
  return gain;
}

// Where the others support a part most, as a motion from where it is; or out.
struct PartMove {
  std::optional<Eigen::Isometry3d> motion;
  bool leaves = false;
};

PartMove move_of(const PairGraph& graph, const Component& component, const AlikeParts& alike,
                 const std::vector<std::size_t>& part) {
  const PairsAcross across(graph, component, alike, part);
  const double here = across.support(Eigen::Isometry3d::Identity());
  const bool contradicted = here < -kLeastGain;
  if (!contradicted && across.most_elsewhere() <= std::max(here, 0.0)) return {};
  const auto motion = across.best_elsewhere(std::max(here, 0.0) + kLeastGain).motion;
  return {motion, contradicted && !motion};
}

bool apply(const PartMove& move, const std::vector<std::size_t>& part, Component& component) {
  for (const std::size_t i : part) {
    if (move.motion) component.T_reference_scan[i] = *move.motion * *component.T_reference_scan[i];
    if (move.leaves) component.T_reference_scan[i].reset();  // a component of its own
  }
  return move.motion || move.leaves;
}

// Parts to where the rest supports them most, or out, one after the other: each by the poses that earlier ones left.
// Few move, so that many are asked side by side, and those behind one that moved again.
bool move_groups(const PairGraph& graph, Component& component, int num_threads) {
  std::optional<AlikeParts> alike(std::in_place, graph, component);
  std::vector<std::vector<std::size_t>> parts = weakest_parts(graph, component, *alike);
  std::erase_if(parts, [](const auto& part) { return part.size() < 2; });
  const auto is_whole = [&](const std::vector<std::size_t>& part) {
    return std::all_of(part.begin(), part.end(), [&](std::size_t i) { return component.has(i); });
  };
  bool moved = false;
  std::vector<PartMove> moves(4 * static_cast<std::size_t>(std::max(1, num_threads)));
  if (num_threads <= 1) moves.resize(1);
  for (std::size_t next = 0; next < parts.size();) {
    const std::size_t count = std::min(moves.size(), parts.size() - next);
    parallel_for(num_threads, count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        moves[k] = is_whole(parts[next + k]) ? move_of(graph, component, *alike, parts[next + k]) : PartMove{};
      }
    });
    bool moved_now = false;
    for (std::size_t k = 0; k < count && !moved_now; ++k, ++next) moved_now = apply(moves[k], parts[next], component);
    if (moved_now) alike.emplace(graph, component);
    moved = moved || moved_now;
  }
  return moved;
}

// Parts that the pairs across speak against where they are, and that lie nowhere better, are out: growing hangs a group
// by the first of its scans, whatever the others say. True where there was one.
bool drop_contradicted(const PairGraph& graph, Component& component) {
  bool dropped = false;
  const AlikeParts alike(graph, component);
  for (const std::vector<std::size_t>& part : weakest_parts(graph, component, alike)) {
    if (!std::all_of(part.begin(), part.end(), [&](std::size_t i) { return component.has(i); })) continue;
    if (PairsAcross(graph, component, alike, part).support(Eigen::Isometry3d::Identity()) >= -kLeastGain) continue;
    for (const std::size_t i : part) component.T_reference_scan[i].reset();
    dropped = true;
  }
  return dropped;
}

// Members that no support joins to the reference any more are out.
void keep_connected(const PairGraph& graph, Component& component) {
  std::vector<bool> reached(graph.num_scans(), false);
  std::vector<std::size_t> open{component.reference};
  reached[component.reference] = true;
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for (const std::size_t k : graph.pairs_of(i)) {
      const ComparedPair& pair = graph.pairs()[k];
      const std::size_t j = pair.a == i ? pair.b : pair.a;
      if (!component.has(j) || reached[j]) continue;
      if (graph.support(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]) <= 0) continue;
      reached[j] = true;
      open.push_back(j);
    }
  }
  for (const std::size_t i : component.members()) {
    if (!reached[i]) component.T_reference_scan[i].reset();
  }
}

std::size_t best_supported(const PairGraph& graph, const Component& component) {
  std::size_t best = component.reference;
  double most = -1e300;
  for (const std::size_t i : component.members()) {
    const double support = graph.support_of(i, *component.T_reference_scan[i], component);
    if (support > most + kLeastGain) most = support, best = i;
  }
  return best;
}

std::vector<Start> strongest(const PairGraph& graph, const std::vector<bool>& open) {
  std::vector<Start> starts;
  for (const ComparedPair& pair : graph.pairs()) {
    if (!open[pair.a] || !open[pair.b]) continue;
    for (const PoseHypothesis& h : pair.hypotheses) {
      if (h.log_odds > 0) starts.push_back({h.log_odds, &pair, &h});
    }
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& x, const Start& y) { return x.log_odds > y.log_odds; });
  return starts;
}

std::size_t num_starts_for(const std::vector<bool>& open, std::ptrdiff_t least, const InferenceOptions& options) {
  const auto num_open = std::count(open.begin(), open.end(), true);
  if (num_open == 0) return 1;
  const auto affordable = std::max<std::ptrdiff_t>(least, options.max_grown_scans / num_open);
  return static_cast<std::size_t>(std::min<std::ptrdiff_t>(options.max_starts, affordable));
}

// Of the known components the one that has most scans that are open, with those alone.
std::optional<Component> known_among(const std::vector<Component>& known, const std::vector<bool>& open) {
  std::optional<Component> best;
  for (Component component : known) {
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (!open[i]) component.T_reference_scan[i].reset();
    }
    const std::vector<std::size_t> members = component.members();
    if (members.size() < 2 || (best && members.size() <= best->size())) continue;
    if (!open[component.reference]) change_reference(component, members.front());
    best = std::move(component);
  }
  return best;
}

void grow_and_improve(const PairGraph& graph, const std::vector<bool>& open, int num_threads, Component& component) {
  grow(graph, open, component);
  for (int round = 0; round < graph.options().max_sweeps; ++round) {
    const std::size_t before = component.size();
    improve(graph, component, num_threads);
    grow(graph, open, component);
    if (component.size() <= before) break;
  }
  while (drop_contradicted(graph, component)) keep_connected(graph, component);
}

// A start that an earlier configuration contains leads to the same one.
bool is_contained(const PairGraph& graph, const std::vector<Component>& tried, const Start& start) {
  const auto [a, b] = std::pair(start.pair->a, start.pair->b);
  return std::any_of(tried.begin(), tried.end(), [&](const Component& c) {
    return c.has(a) && c.has(b) &&
           graph.same_pose(b, c.T_reference_scan[a]->inverse() * *c.T_reference_scan[b], start.hypothesis->T_a_b);
  });
}

}  // namespace

double log_likelihood(const PairGraph& graph, const Component& component) {
  double sum = -graph.options().log_poses * static_cast<double>(component.size() - 1);
  for (const ComparedPair& pair : graph.pairs()) {
    if (!component.has(pair.a) || !component.has(pair.b)) continue;
    sum += graph.support(pair, *component.T_reference_scan[pair.a], *component.T_reference_scan[pair.b]);
  }
  return sum;
}

void improve(const PairGraph& graph, Component& component, int num_threads) {
  for (int sweep = 0; sweep < graph.options().max_sweeps; ++sweep) {
    bool moved = move_scans(graph, component);
    moved = move_groups(graph, component, num_threads) || moved;
    for (int k = 0; k < graph.options().max_sweeps && average_poses(graph, component) > kLeastAverage; ++k) {
    }
    keep_connected(graph, component);
    if (!moved) return;
  }
}

void change_reference(Component& component, std::size_t reference) {
  const Eigen::Isometry3d T_new_old = component.T_reference_scan[reference]->inverse();
  for (auto& T : component.T_reference_scan) {
    if (T) T = T_new_old * *T;
  }
  component.T_reference_scan[reference] = Eigen::Isometry3d::Identity();
  component.reference = reference;
}

std::vector<Component> likeliest_components(const PairGraph& graph, const std::vector<Component>& known,
                                            int least_starts, int num_threads) {
  const std::size_t n = graph.num_scans();
  std::vector<Component> out;
  std::vector<bool> open(n, true);
  while (true) {
    std::optional<Component> best;
    double most = 0;
    std::vector<Component> tried;
    const auto attempt = [&](Component component) {
      grow_and_improve(graph, open, num_threads, component);
      const double likelihood = log_likelihood(graph, component);
      if (likelihood > most + kLeastGain) most = likelihood, best = component;
      tried.push_back(std::move(component));
    };
    std::optional<Component> from_known = known_among(known, open);
    const std::size_t num_starts = num_starts_for(open, least_starts, graph.options());
    if (from_known) attempt(std::move(*from_known));
    for (const Start& start : strongest(graph, open)) {
      if (tried.size() >= num_starts) break;
      if (is_contained(graph, tried, start)) continue;
      Component component = component_of_one(start.pair->a, n);
      component.T_reference_scan[start.pair->b] = start.hypothesis->T_a_b;
      attempt(std::move(component));
    }
    if (!best || best->size() < 2) break;
    change_reference(*best, best_supported(graph, *best));
    for (const std::size_t i : best->members()) open[i] = false;
    out.push_back(std::move(*best));
  }
  std::stable_sort(out.begin(), out.end(), [](const Component& a, const Component& b) { return a.size() > b.size(); });
  return out;
}

}  // namespace tcm_icp
