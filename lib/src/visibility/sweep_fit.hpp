#pragma once
// The centre and axis about which scan lines were swept. Lengths are in units of a UnitFrame.

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "line_pieces.hpp"

namespace tcm_icp {

struct Sweep {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double sigma = 0;  ///< standard deviation of the centre in its weakest direction
};

/// Sine of the angle, along its plane, between the i-th piece and the sweep's line through its middle; nothing where
/// that has no direction.
std::optional<double> sweep_residual(const Sweep& sweep, const LinePieces& pieces, std::size_t i);

/// What pieces say of a sweep.
struct SweepSupport {
  std::size_t rows = 0;    ///< along lines about its axis
  std::size_t others = 0;  ///< neither along those nor in planes through the axis

  double share() const { return rows == 0 ? 0 : static_cast<double>(rows) / static_cast<double>(rows + others); }
};

/// @param tolerance  sine of the angle that pieces may be off
SweepSupport support_of_sweep(const Sweep& sweep, const LinePieces& pieces, double tolerance);

/// The axis of most of the pieces, as seen from the centre: rows about it are at a right angle to it on the sphere of
/// directions.
Eigen::Vector3d likely_axis(const Eigen::Vector3d& centre, const LinePieces& pieces);

/// Gauss-Newton with Geman-McClure's weights, one in `stride` of the pieces. O(pieces / stride), some 25 times.
/// @param scale  that the weights begin with: about the residuals of the start
Sweep fit_sweep(const Sweep& start, const LinePieces& pieces, std::size_t stride, double scale);

}  // namespace tcm_icp
