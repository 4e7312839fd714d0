#pragma once
// How well two height maps agree at a pose, cell by cell, and the pose nearby at which they agree best.

#include "correlation_peaks.hpp"
#include "tcm_icp/coarse/height_map.hpp"

namespace tcm_icp {

/// The seen cells of a map, at most so many, evenly spread.
struct MapCells {
  std::vector<Eigen::Vector2f> position;  ///< [cells] from the middle of the map
  std::vector<float> detail, structure, height;
  double share = 1;  ///< of the map's seen cells
};

MapCells list_cells(const HeightMap& map, std::size_t max_cells);

/// Score of a pose: normalised correlation of the shared cells' details by the root of their number; 0 with fewer than
/// `min_shared`.
double agreement(const HeightMap& target, const MapCells& source, const MapPeak& pose, double min_shared);

/// The best of the poses within `heading_step_rad` and one cell, and its score.
MapPeak refine_peak(const HeightMap& target, const MapCells& source, const MapPeak& start, double heading_step_rad,
                    double min_shared);

/// Both maps' cells that lie over one another at the pose: points of the two map frames [m].
struct SharedCells {
  Points target, source;
};
SharedCells shared_cells(const HeightMap& target, const HeightMap& source, const MapCells& cells, const MapPeak& pose);

}  // namespace tcm_icp
