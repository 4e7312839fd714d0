#pragma once
// What a scan's points say of the place it was taken from, found while their neighbours are at hand.

#include "tcm_icp/visibility/point_density.hpp"
#include "tcm_icp/visibility/scan_lines.hpp"

namespace tcm_icp {

struct ViewpointClues {
  LinePieces line_pieces;  ///< none where the points were thinned
  DensitySamples densities;
};

}  // namespace tcm_icp
