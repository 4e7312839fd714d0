#pragma once
// Flat places of a scan, and the pieces of scan lines that they show from a place. Lengths are in units of a UnitFrame.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "unit_frame.hpp"

namespace tcm_icp {

/// Places where points lie in a row, much nearer to one another than to the next row.
struct LinePieces {
  Points middles;
  Points directions;  ///< unit length, the sign means nothing
  Points normals;     ///< of the planes they lie on, unit length
};

/// The nearest neighbours of a point, which lie on a plane but for noise.
struct FlatPatch {
  static constexpr std::size_t kPoints = 40;
  using Coordinates = std::array<float, kPoints>;

  Eigen::Vector3d middle;
  Eigen::Matrix3d axes;  ///< columns: two along the plane, its normal
  Coordinates x, y, z;   ///< along the axes, from the middle; the point itself is the first
};

/// Those of up to 6,000 points, the same for the same points.
/// Cost: a query of 40 neighbours a point, 30 ms.
std::vector<FlatPatch> find_flat_patches(const Points& points, const NeighborIndex& index, const UnitFrame& frame);

/// Where the patches, one in `stride` of them, show points in a row once each point is moved along its ray from `from`
/// to the plane.
LinePieces find_line_pieces(const std::vector<FlatPatch>& patches, const Eigen::Vector3d& from, std::size_t stride);

}  // namespace tcm_icp
