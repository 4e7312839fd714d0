#pragma once
// What a scan's points say of the place it was taken from, found while their neighbours are at hand.

#include <optional>

#include "tcm_icp/visibility/point_density.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

struct ViewpointClues {
  std::optional<Viewpoint> by_lines;  ///< the place itself, where scan lines tell it
  DensitySamples densities;
};

}  // namespace tcm_icp
