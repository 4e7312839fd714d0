#pragma once
// A height map in the frequency domain, at one heading.

#include "fourier.hpp"
#include "tcm_icp/coarse/height_map.hpp"

namespace tcm_icp {

struct MapSpectra {
  Spectrum detail;
  Spectrum structure;
  Spectrum mask;  ///< low frequencies only: of the grid kMaskStep times as coarse
};

/// The count of shared cells changes slowly with the shift, so it is computed at every kMaskStep-th shift.
constexpr int kMaskStep = 4;

struct MapImages {
  Image detail;
  Image structure;
  Image mask;
};

/// The map turned by `heading_rad` about the middle of a grid of `grid_size`.
MapImages turned_images(const HeightMap& map, double heading_rad, int grid_size);

/// The map turned by exactly 0 or 90 degrees, without interpolation.
MapImages upright_images(const HeightMap& map, bool quarter_turn, int grid_size);

MapSpectra transform(const MapImages& images, const Fourier& fourier);

}  // namespace tcm_icp
