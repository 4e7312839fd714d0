#include "links/height_map_search.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>
#include <utility>

#include "links/pair_steps.hpp"

namespace tcm_icp {
namespace {

// Pairs whose height maps are compared together: they share transforms; what is cut off is done again.
constexpr std::size_t kBlock = 100;

ScansFromAbove from_above(const std::vector<PreparedScan>& scans, bool levelled) {
  std::vector<const Cloud*> clouds;
  for (const auto& scan : scans) clouds.push_back(&scan.fine.cloud);
  VerticalOptions vertical;
  vertical.levelled = levelled;
  return ScansFromAbove(std::move(clouds), vertical);
}

HeightCorrelationOptions screening_on(const CorrelationGrid& grid) {
  HeightCorrelationOptions options = screening_options();
  options.grid = grid;
  return options;
}

HeightCorrelationOptions full_on(const CorrelationGrid& grid, int depth) {
  HeightCorrelationOptions options;
  options.depth = depth;
  options.grid = grid;
  return options;
}

}  // namespace

HeightMapSearch::HeightMapSearch(const std::vector<PreparedScan>& scans, bool levelled, const RunContext& context,
                                 const KeptSearches& kept)
    : scans_(scans), from_above_(from_above(scans, levelled)), context_(context), kept_(kept) {}

std::vector<HeightMapGrids> HeightMapSearch::grids_of(const ScanPairs& pairs) {
  if (of_scans_.empty()) {
    const auto of_scans = [&](const HeightCorrelationOptions& options) {
      if (kept_.store != nullptr) {
        return grids_once(*kept_.store, digests_of(scans_), kept_.base, from_above_, options, context_.num_threads);
      }
      return std::vector<CorrelationGrid>(scans_.size(),
                                          choose_correlation_grid(from_above_, options, context_.num_threads));
    };
    const auto screening = of_scans(screening_on({})), full = of_scans(full_on({}, kUsualDepth));
    for (std::size_t i = 0; i < scans_.size(); ++i) of_scans_.push_back({screening[i], full[i]});
  }
  std::vector<HeightMapGrids> out;
  for (const auto& [a, b] : pairs) {
    out.push_back({grid_of_pair(of_scans_[a].screening, of_scans_[b].screening),
                   grid_of_pair(of_scans_[a].full, of_scans_[b].full)});
  }
  return out;
}

std::vector<std::vector<PoseCandidate>> HeightMapSearch::candidates(const ScanPairs& pairs, int depth) {
  auto& known = found_[depth];
  ScanPairs open;
  for (const auto& pair : pairs) {
    if (!known.contains(pair)) open.push_back(pair);
  }
  auto found = candidates_on(grids_of(open), open, depth);
  for (std::size_t k = 0; k < open.size(); ++k) known.emplace(open[k], std::move(found[k]));
  std::vector<std::vector<PoseCandidate>> out;
  for (const auto& pair : pairs) out.push_back(known.at(pair));
  return out;
}

std::vector<std::vector<PoseCandidate>> HeightMapSearch::candidates_on(const std::vector<HeightMapGrids>& grids,
                                                                       const ScanPairs& pairs, int depth) {
  std::vector<std::vector<PoseCandidate>> out(pairs.size());
  const auto key = [&](std::size_t k) {
    return height_map_key(scans_[pairs[k].first], scans_[pairs[k].second], from_above_.vertical(),
                          screening_on(grids[k].screening), full_on(grids[k].full, depth));
  };
  std::map<std::tuple<double, int, double, int>, std::vector<std::size_t>> missing;  // by grids
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    auto known = kept_.store != nullptr ? find_candidates(*kept_.store, key(k)) : std::nullopt;
    if (known) out[k] = std::move(*known);
    const auto& [screening, full] = grids[k];
    if (!known) missing[{screening.cell_m, screening.size, full.cell_m, full.size}].push_back(k);
  }
  const std::string stage = depth == kUsualDepth ? "comparing height maps" : "comparing more of height maps";
  for (const auto& [grid, places] : missing) {
    const std::size_t num_blocks = (places.size() + kBlock - 1) / kBlock;
    for (std::size_t number = 0; number < num_blocks; ++number) {
      const std::size_t first = places.size() * number / num_blocks;
      const std::size_t size = places.size() * (number + 1) / num_blocks - first;
      context_.report(stage, first, places.size());
      ScanPairs block;
      for (std::size_t i = first; i < first + size; ++i) block.push_back(pairs[places[i]]);
      const auto start = std::chrono::steady_clock::now();
      auto found = search(block, grids[places[first]], depth);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t k = places[first + i];
        if (kept_.store != nullptr) {
          save_candidates(*kept_.store, key(k), found[i], elapsed.count() / static_cast<double>(size));
        }
        out[k] = std::move(found[i]);
      }
    }
  }
  return out;
}

std::vector<double> HeightMapSearch::scores(const ScanPairs& pairs) {
  const std::vector<HeightMapGrids> grids = grids_of(pairs);
  std::map<std::pair<double, int>, ScanPairs> by_grid;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    by_grid[{grids[k].screening.cell_m, grids[k].screening.size}].push_back(pairs[k]);
  }
  for (const auto& [grid, on_it] : by_grid) screen(on_it, {grid.first, grid.second});
  std::vector<double> out;
  for (const auto& pair : pairs) out.push_back(screened_.at(pair).score);
  return out;
}

std::vector<std::vector<PoseCandidate>> HeightMapSearch::search(const ScanPairs& pairs, const HeightMapGrids& grids,
                                                                int depth) {
  screen(pairs, grids.screening);
  std::vector<ScanPair> wanted;
  for (const auto& pair : pairs) wanted.push_back({pair.first, pair.second, screened_.at(pair).ups});
  return correlate_height_maps(from_above_, wanted, full_on(grids.full, depth), context_.num_threads);
}

// What was not screened yet.
void HeightMapSearch::screen(const ScanPairs& pairs, const CorrelationGrid& grid) {
  std::vector<ScanPair> open;
  for (const auto& pair : pairs) {
    if (!screened_.contains(pair)) open.push_back({pair.first, pair.second});
  }
  auto found = screen_by_height_maps(from_above_, open, screening_on(grid), context_.num_threads);
  for (std::size_t k = 0; k < open.size(); ++k) {
    screened_.emplace(ScanPairs::value_type(open[k].target, open[k].source), std::move(found[k]));
  }
}

}  // namespace tcm_icp
