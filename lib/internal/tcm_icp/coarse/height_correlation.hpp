#pragma once
// Poses of pairs of scans with no initial guess: height maps correlated over all headings and shifts.

#include <cstddef>
#include <vector>

#include "tcm_icp/coarse/height_map.hpp"
#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/coarse/scans_from_above.hpp"

namespace tcm_icp {

/// Cells of the maps, common to all scans that are compared.
struct CorrelationGrid {
  double cell_m = 0;
  int size = 0;  ///< cells an edge; 0: follows from the scans
};

struct HeightCorrelationOptions {
  int cells_across = 80;           ///< >= 16; cells a typical scan is wide in the search; twice as many decide
  int max_grid = 384;              ///< >= 64; cells the search grid is wide at most; longer scans get larger cells
  double heading_step_deg = 5;     ///< > 0, <= 15; rounded so that a quarter turn is a whole number of steps
  double min_shared_share = 0.05;  ///< 0..1; shared cells by the cells of the smaller scan
  int max_candidates = 5;          ///< >= 1; per pair
  int depth = 1;                   ///< >= 1; how many times as many peaks are refined, and poses returned
  HeightMapOptions map;
  CorrelationGrid grid;   ///< choose_correlation_grid() of a set that the scans belong to, or nothing
  void validate() const;  ///< throws InvalidOptions
};

/// Directions that may be up in both scans of a pair, by their places in find_up_directions().
struct UpPair {
  std::size_t target = 0;
  std::size_t source = 0;
};

/// Two scans of a set, by their places in it.
struct ScanPair {
  std::size_t target = 0;
  std::size_t source = 0;
  std::vector<UpPair> ups{};  ///< to search; none: all there are
};

/// The grid that the functions below take for these scans: all pairs of a set have one, also where some of them are
/// looked at alone. @throws InvalidInput  as they do
CorrelationGrid choose_correlation_grid(ScansFromAbove& scans, const HeightCorrelationOptions& options,
                                        int num_threads);

/// For each pair up to depth x max_candidates clearly different poses, the best score first. Score: mean of the
/// normalised correlations of heights and of walls over the shared cells, by the root of twice their number; a pose by
/// chance has about 10. The best pose's margin is against the second, the others' against the best.
///
/// @throws InvalidInput  if a cloud has fewer than 3 points, all are equal, or a pair is out of range
/// Cost: 72 inverse transforms a pair, 20 to 60 ms of processor time; memory for nine spectra a scan. The result does
/// not depend on the number of threads.
std::vector<std::vector<PoseCandidate>> correlate_height_maps(ScansFromAbove& scans, const std::vector<ScanPair>& pairs,
                                                              const HeightCorrelationOptions& options, int num_threads);

/// The same search on coarse maps, with as little as it takes to tell pairs worth a full search: cells and headings are
/// twice as far apart.
inline HeightCorrelationOptions screening_options() {
  HeightCorrelationOptions options;
  options.cells_across = 40;
  options.max_grid = 192;
  options.heading_step_deg = 10;
  return options;
}

/// What a search on coarse maps says of a pair.
struct PairScreening {
  double score = 0;         ///< of the best peak, before anything is refined; 0 where there is none
  std::vector<UpPair> ups;  ///< worth a full search, the best first
};

/// Scores are larger where more is shared, so they rank partners of a scan; they are no verdict. Of directions that may
/// be up, a pair keeps two at most: those whose peaks come to 0.8 of the best.
/// @throws InvalidInput  as above
/// Cost: with screening_options() 36 inverse transforms a pair, about 1 ms of processor time, for each of the ways that
/// both may be up.
std::vector<PairScreening> screen_by_height_maps(ScansFromAbove& scans, const std::vector<ScanPair>& pairs,
                                                 const HeightCorrelationOptions& options, int num_threads);

}  // namespace tcm_icp
