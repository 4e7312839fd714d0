#pragma once
// The centre and axis about which scan lines were swept. Lengths are in units of a UnitFrame.

#include <Eigen/Core>
#include <cstddef>

#include "tcm_icp/visibility/scan_lines.hpp"

namespace tcm_icp {

struct Sweep {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double sigma = 0;  ///< standard deviation of the centre in its weakest direction
};

/// Sine of the angle between the piece and the cone of the sweep that meets it: 0 for pieces of its lines.
double sweep_residual(const Sweep& sweep, const Eigen::Vector3d& middle, const Eigen::Vector3d& direction);

/// Share of the pieces, one in `stride` of them, with a residual below `tolerance`.
double share_of_sweep(const Sweep& sweep, const LinePieces& pieces, double tolerance, std::size_t stride);

/// The direction that lines have least of: the axis where they run around it over ground, whichever way is up.
Eigen::Vector3d likely_axis(const LinePieces& pieces);

/// Gauss-Newton from a start that is a few tenths off, one in `stride` of the pieces. O(pieces / stride), some 25
/// times.
Sweep fit_sweep(const Sweep& start, const LinePieces& pieces, std::size_t stride);

}  // namespace tcm_icp
