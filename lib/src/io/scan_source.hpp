#pragma once
// What ScanReader needs of a file format: one record after the other.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

class ScanSource {
 public:
  virtual ~ScanSource() = default;

  virtual const std::vector<Attribute>& attributes() const = 0;

  /// The next record, finite or not; false at the end. A record that holds no point (an empty cell of a grid, one
  /// marked as invalid) has NaN for coordinates.
  /// @param attributes  attribute_stride() bytes to fill, or nullptr where they are not wanted
  virtual bool next(Eigen::Vector3d& point, std::byte* attributes) = 0;

  /// What the file says of the scan's place: maps its coordinates into a frame common to the scans of the file. As it
  /// stands there, rigid or not.
  virtual std::optional<Eigen::Matrix4d> header_pose() const { return std::nullopt; }

  /// What the file says of the coordinate system its points are in; empty where it says nothing.
  virtual std::string coordinate_system() const { return {}; }
};

}  // namespace tcm_icp
