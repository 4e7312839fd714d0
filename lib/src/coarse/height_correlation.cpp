#include "tcm_icp/coarse/height_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "correlation_peaks.hpp"
#include "map_agreement.hpp"
#include "map_pose.hpp"
#include "map_spectra.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// A grid half as wide again as the widest scan: shifts up to half its width do not wrap around.
constexpr double kPadding = 1.5;
constexpr double kMinWidthShare = 0.01;  // of the length, for scans on a line
// The search's best peaks are turned and shifted on its own maps, the best of them on maps with cells half as wide;
// so many by depth.
constexpr std::size_t kPeaksRefined = 24, kCellsRefined = 2000;
constexpr std::size_t kPeaksFine = 8, kCellsFine = 4000;
constexpr int kFineScale = 2;
// Nearer poses are one pose, found twice.
constexpr double kDistinctSteps = 3;
constexpr double kOpposite = -0.999;    // cosine of two directions that are one axis
constexpr double kDistinctShare = 0.1;  // of a typical scan's width
// Of ways that both scans may be up: those looked at in full, and what their peaks on coarse maps come to.
constexpr std::size_t kPeaksScreened = 8, kMaxUps = 2;
constexpr double kLikelyUps = 0.8;
// Spectra are kept of so many scans at once.
constexpr std::size_t kScansAtOnce = 64;

// One scan from above, for each way that may be up.
struct ScanMaps {
  // Whether the same axis is looked at with both signs; and whether this is the second of the two.
  bool has_both_signs(std::size_t map) const {
    return is_second_sign(map) || (map + 1 < maps.size() && is_second_sign(map + 1));
  }
  bool is_second_sign(std::size_t map) const { return map > 0 && up(map - 1).dot(up(map)) < kOpposite; }

  Eigen::Vector3d up(std::size_t map) const { return maps[map].T_map_scan.linear().row(2); }

  std::vector<HeightMap> maps, fine_maps;
  std::vector<MapCells> cells, fine_cells;
  std::vector<MapSpectra> upright, quarter_turned;  // as a target
  std::vector<MapSpectra> turned;                   // as a source, at the heading that is being searched
};

struct HeightSearch {
  HeightSearch(ScansFromAbove& from, const HeightCorrelationOptions& o, int threads)
      : from_above(from), options(o), num_threads(threads), scans(from.size()) {}

  ScansFromAbove& from_above;
  const HeightCorrelationOptions& options;
  int num_threads;
  std::vector<ScanMaps> scans;
  double cell_m = 0;
  int grid_size = 0;

  void choose_grid();
  void make_maps(const std::vector<std::size_t>& members);
  void make_fine_maps(const std::vector<std::size_t>& members);
  void drop_maps(const std::vector<std::size_t>& members);
  std::vector<PeakList> correlate(std::span<const ScanPair> pairs, const std::vector<std::size_t>& members,
                                  std::size_t num_peaks);
  std::vector<PoseCandidate> candidates(const ScanPair& pair, const PeakList& peaks) const;
  double min_shared(const HeightMap& a, const HeightMap& b) const {
    return std::max(30.0, options.min_shared_share * std::min(a.num_seen, b.num_seen));
  }
  std::size_t deep(std::size_t count) const { return count * static_cast<std::size_t>(options.depth); }
  int steps_per_quarter() const { return static_cast<int>(std::lround(90 / options.heading_step_deg)); }
  double heading_step_rad() const { return EIGEN_PI / 2 / steps_per_quarter(); }
};

void HeightSearch::choose_grid() {
  if (options.grid.size > 0) {
    cell_m = options.grid.cell_m;
    grid_size = options.grid.size;
    return;
  }
  from_above.find_all(num_threads);
  std::vector<double> width_m;
  double largest_m = 0;
  for (std::size_t i = 0; i < from_above.size(); ++i) {
    width_m.push_back(from_above.footprints(i).front().width_m);
    for (const auto& footprint : from_above.footprints(i)) largest_m = std::max(largest_m, 2 * footprint.radius_m);
  }
  // A line has no width: a share of its length, then.
  const double typical_m = std::max(median(width_m), kMinWidthShare * largest_m);
  cell_m = std::max(typical_m / options.cells_across, kPadding * largest_m / options.max_grid);
  grid_size = fast_size(static_cast<int>(kPadding * largest_m / cell_m));
}

void HeightSearch::make_maps(const std::vector<std::size_t>& members) {
  from_above.find(members, num_threads);
  const Fourier fourier(grid_size);
  parallel_for(num_threads, members.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      const std::size_t i = members[m];
      for (const auto& footprint : from_above.footprints(i)) {
        scans[i].maps.push_back(make_height_map(from_above.cloud(i), footprint, cell_m, options.map));
        const HeightMap& map = scans[i].maps.back();
        scans[i].upright.push_back(transform(upright_images(map, false, grid_size), fourier));
        scans[i].quarter_turned.push_back(transform(upright_images(map, true, grid_size), fourier));
      }
    }
  });
}

// In place of the spectra: both would be most of what a set takes.
void HeightSearch::make_fine_maps(const std::vector<std::size_t>& members) {
  parallel_for(num_threads, members.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      ScanMaps& scan = scans[members[m]];
      for (auto* spectra : {&scan.upright, &scan.quarter_turned, &scan.turned})
        std::vector<MapSpectra>().swap(*spectra);
      for (const auto& map : scan.maps) scan.cells.push_back(list_cells(map, kCellsRefined));
      for (const auto& footprint : from_above.footprints(members[m])) {
        scan.fine_maps.push_back(
            make_height_map(from_above.cloud(members[m]), footprint, cell_m / kFineScale, options.map));
        scan.fine_cells.push_back(list_cells(scan.fine_maps.back(), kCellsFine));
      }
    }
  });
}

void HeightSearch::drop_maps(const std::vector<std::size_t>& members) {
  for (const std::size_t i : members) scans[i] = ScanMaps{};
}

bool wanted(const ScanPair& pair, std::size_t target_map, std::size_t source_map) {
  return pair.ups.empty() || std::any_of(pair.ups.begin(), pair.ups.end(), [&](const UpPair& up) {
           return up.target == target_map && up.source == source_map;
         });
}

std::vector<PeakList> HeightSearch::correlate(std::span<const ScanPair> pairs, const std::vector<std::size_t>& members,
                                              std::size_t num_peaks) {
  const double distinct_cells = kDistinctShare * options.cells_across;
  std::vector<PeakList> lists(pairs.size(), PeakList(num_peaks, 1.5 * heading_step_rad(), distinct_cells / 2));
  const Fourier fourier(grid_size), mask_fourier(grid_size / kMaskStep);
  // All scans at one heading, then all pairs: memory stays at one spectrum a scan.
  for (int step = 0; step < steps_per_quarter(); ++step) {
    const double heading_rad = step * heading_step_rad();
    parallel_for(num_threads, members.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) {
        const std::size_t i = members[m];
        scans[i].turned.clear();
        for (const auto& map : scans[i].maps) {
          scans[i].turned.push_back(transform(turned_images(map, heading_rad, grid_size), fourier));
        }
      }
    });
    parallel_for(num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
      CorrelationScratch scratch;
      for (std::size_t k = begin; k < end; ++k) {
        const ScanMaps& target = scans[pairs[k].target];
        const ScanMaps& source = scans[pairs[k].source];
        MapPeak peak;
        for (peak.target_map = 0; peak.target_map < target.maps.size(); ++peak.target_map) {
          for (peak.source_map = 0; peak.source_map < source.maps.size(); ++peak.source_map) {
            // Both scans upside down is the pose of both upright, seen from below.
            if (target.is_second_sign(peak.target_map) && source.has_both_signs(peak.source_map)) continue;
            if (!wanted(pairs[k], peak.target_map, peak.source_map)) continue;
            const double least = min_shared(target.maps[peak.target_map], source.maps[peak.source_map]);
            for (const bool quarter : {false, true}) {
              peak.heading_rad = heading_rad;
              add_correlation_peaks((quarter ? target.quarter_turned : target.upright)[peak.target_map], quarter,
                                    source.turned[peak.source_map], fourier, mask_fourier, least, peak, scratch,
                                    lists[k]);
            }
          }
        }
      }
    });
  }
  return lists;
}

std::vector<PoseCandidate> HeightSearch::candidates(const ScanPair& pair, const PeakList& list) const {
  const ScanMaps& target = scans[pair.target];
  const ScanMaps& source = scans[pair.source];
  const auto by_score = [](const MapPeak& a, const MapPeak& b) { return a.score > b.score; };
  std::vector<MapPeak> refined;
  for (MapPeak peak : list.peaks()) {
    const HeightMap& map = target.maps[peak.target_map];
    const double least = min_shared(map, source.maps[peak.source_map]);
    peak = refine_peak(map, source.cells[peak.source_map], peak, 0.4 * heading_step_rad(), least);
    if (peak.score > 0) refined.push_back(peak);
  }
  std::stable_sort(refined.begin(), refined.end(), by_score);
  const double heading_rad = kDistinctSteps * heading_step_rad(), cells = kDistinctShare * options.cells_across;
  const auto drop_near = [&](double scale) {
    std::vector<MapPeak> distinct;
    for (const MapPeak& peak : refined) {
      if (std::none_of(distinct.begin(), distinct.end(),
                       [&](const MapPeak& p) { return are_near(p, peak, heading_rad, scale * cells); })) {
        distinct.push_back(peak);
      }
    }
    refined = distinct;
  };
  drop_near(1);
  if (refined.size() > deep(kPeaksFine)) refined.resize(deep(kPeaksFine));
  for (MapPeak& peak : refined) {
    const HeightMap& map = target.fine_maps[peak.target_map];
    const double least = min_shared(map, source.fine_maps[peak.source_map]);
    peak.x *= kFineScale;
    peak.y *= kFineScale;
    for (const double part : {0.3, 0.15}) {
      peak = refine_peak(map, source.fine_cells[peak.source_map], peak, part * heading_step_rad(), least);
    }
  }
  std::stable_sort(refined.begin(), refined.end(), by_score);
  drop_near(kFineScale);
  // Where the fine maps share too little there is no pose, and nothing to be a margin against.
  std::erase_if(refined, [](const MapPeak& peak) { return !(peak.score > 0); });
  const std::vector<MapPeak>& distinct = refined;
  std::vector<PoseCandidate> out;
  const std::size_t most = deep(static_cast<std::size_t>(options.max_candidates));
  for (std::size_t i = 0; i < std::min(distinct.size(), most); ++i) {
    const MapPeak& peak = distinct[i];
    const MapPeak* rival = i > 0 ? &distinct[0] : distinct.size() > 1 ? &distinct[1] : nullptr;
    PoseCandidate candidate;
    candidate.method = CoarseMethod::kHeightMap;
    candidate.T_target_source = lift_pose(target.fine_maps[peak.target_map], source.fine_maps[peak.source_map],
                                          source.fine_cells[peak.source_map], peak);
    candidate.score = peak.score;
    candidate.accuracy_m = cell_m / kFineScale;
    candidate.margin = rival ? peak.score / rival->score : peak.score;
    out.push_back(candidate);
  }
  return out;
}

}  // namespace

void HeightCorrelationOptions::validate() const {
  const auto require = [](bool ok, const char* name, double value, const char* bound) {
    if (!ok) throw InvalidOptions(std::string(name) + " is " + std::to_string(value) + "; it must be " + bound);
  };
  require(cells_across >= 16, "cells_across", cells_across, "at least 16");
  require(max_grid >= 64, "max_grid", max_grid, "at least 64");
  require(heading_step_deg > 0 && heading_step_deg <= 15, "heading_step_deg", heading_step_deg, "in (0, 15]");
  require(min_shared_share >= 0 && min_shared_share <= 1, "min_shared_share", min_shared_share, "between 0 and 1");
  require(max_candidates >= 1, "max_candidates", max_candidates, "at least 1");
  require(depth >= 1, "depth", depth, "at least 1");
  map.validate();
}

namespace {

void check_pairs(std::size_t num_scans, const std::vector<ScanPair>& pairs) {
  for (const auto& pair : pairs) {
    if (pair.target >= num_scans || pair.source >= num_scans) {
      throw InvalidInput("a pair of scans " + std::to_string(pair.target) + " and " + std::to_string(pair.source) +
                         " in a set of " + std::to_string(num_scans));
    }
  }
}

// The end of the pairs from `begin` on that name no more scans than are kept at once; and those scans.
std::size_t next_block(const std::vector<ScanPair>& pairs, std::size_t begin, std::vector<std::size_t>& members) {
  std::set<std::size_t> in;
  std::size_t end = begin;
  for (; end < pairs.size(); ++end) {
    const std::size_t more = (in.contains(pairs[end].target) ? 0 : 1) + (in.contains(pairs[end].source) ? 0 : 1);
    if (in.size() + more > kScansAtOnce) break;
    in.insert({pairs[end].target, pairs[end].source});
  }
  members.assign(in.begin(), in.end());
  return end;
}

// use(search, first pair of a block, peaks of its pairs), block by block.
template <typename Use>
void search_in_blocks(ScansFromAbove& scans, const std::vector<ScanPair>& pairs,
                      const HeightCorrelationOptions& options, int num_threads, bool for_candidates, Use use) {
  options.validate();
  check_pairs(scans.size(), pairs);
  if (pairs.empty()) return;
  HeightSearch search(scans, options, num_threads);
  search.choose_grid();
  std::vector<std::size_t> members;
  for (std::size_t begin = 0; begin < pairs.size();) {
    const std::size_t end = next_block(pairs, begin, members);
    search.make_maps(members);
    const auto block = std::span(pairs).subspan(begin, end - begin);
    const auto peaks = search.correlate(block, members, for_candidates ? search.deep(kPeaksRefined) : kPeaksScreened);
    if (for_candidates) search.make_fine_maps(members);
    use(search, begin, peaks);
    search.drop_maps(members);
    begin = end;
  }
}

}  // namespace

CorrelationGrid choose_correlation_grid(ScansFromAbove& scans, const HeightCorrelationOptions& options,
                                        int num_threads) {
  options.validate();
  HeightSearch search(scans, options, num_threads);
  search.choose_grid();
  return {search.cell_m, search.grid_size};
}

std::vector<PairScreening> screen_by_height_maps(ScansFromAbove& scans, const std::vector<ScanPair>& pairs,
                                                 const HeightCorrelationOptions& options, int num_threads) {
  std::vector<PairScreening> out(pairs.size());
  const auto keep = [&](const HeightSearch&, std::size_t first, const std::vector<PeakList>& lists) {
    for (std::size_t k = 0; k < lists.size(); ++k) {
      PairScreening& pair = out[first + k];
      for (const MapPeak& peak : lists[k].peaks()) {
        pair.score = std::max(pair.score, peak.score);
        const bool known = std::any_of(pair.ups.begin(), pair.ups.end(), [&](const UpPair& up) {
          return up.target == peak.target_map && up.source == peak.source_map;
        });
        if (known || pair.ups.size() == kMaxUps || peak.score < kLikelyUps * pair.score) continue;
        pair.ups.push_back({peak.target_map, peak.source_map});
      }
    }
  };
  search_in_blocks(scans, pairs, options, num_threads, false, keep);
  return out;
}

std::vector<std::vector<PoseCandidate>> correlate_height_maps(ScansFromAbove& scans, const std::vector<ScanPair>& pairs,
                                                              const HeightCorrelationOptions& options,
                                                              int num_threads) {
  std::vector<std::vector<PoseCandidate>> out(pairs.size());
  search_in_blocks(scans, pairs, options, num_threads, true,
                   [&](const HeightSearch& search, std::size_t first, const std::vector<PeakList>& lists) {
                     parallel_for(num_threads, lists.size(), [&](std::size_t begin, std::size_t end) {
                       for (std::size_t k = begin; k < end; ++k) {
                         out[first + k] = search.candidates(pairs[first + k], lists[k]);
                       }
                     });
                   });
  return out;
}

}  // namespace tcm_icp
