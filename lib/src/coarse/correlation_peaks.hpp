#pragma once
// Where two height maps agree best, over all shifts at one heading.

#include <cstddef>
#include <vector>

#include "map_spectra.hpp"

namespace tcm_icp {

/// A heading and shift of the source map over the target map.
struct MapPeak {
  double score = 0;
  double heading_rad = 0;
  double x = 0, y = 0;         ///< [cells] of the target map; x_target = turned x_source + (x, y)
  std::size_t target_map = 0;  ///< by the scan's up directions
  std::size_t source_map = 0;
};

/// The best peaks of one pair. Of two near each other the better is kept.
class PeakList {
 public:
  PeakList(std::size_t capacity, double near_heading_rad, double near_cells)
      : capacity_(capacity), near_heading_rad_(near_heading_rad), near_cells_(near_cells) {}

  /// What a peak must exceed to get in.
  double floor() const { return peaks_.size() < capacity_ ? 0 : peaks_.back().score; }
  void add(const MapPeak& peak);
  const std::vector<MapPeak>& peaks() const { return peaks_; }  ///< best first

 private:
  std::size_t capacity_;
  double near_heading_rad_, near_cells_;
  std::vector<MapPeak> peaks_;
};

/// True where both heading and shift are near, on maps of the same up directions.
bool are_near(const MapPeak& a, const MapPeak& b, double heading_rad, double cells);

/// Buffers of one thread.
struct CorrelationScratch {
  Spectrum detail[2], mask[2];
  Image agreement, shared;
};

/// Correlates the source at its heading, and half a turn further (the conjugate spectrum, for nothing), and adds the
/// best shifts. `peak` names maps and the heading of the source relative to the target; scores are correlation sums by
/// the square root of the shared cells, shifts with fewer than `min_shared` are left out.
void add_correlation_peaks(const MapSpectra& target, bool target_is_quarter_turned, const MapSpectra& source,
                           const Fourier& fourier, const Fourier& mask_fourier, double min_shared, MapPeak peak,
                           CorrelationScratch& scratch, PeakList& list);

}  // namespace tcm_icp
