#pragma once
// What ScanReader needs of a file format: one record after the other.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

class ScanSource {
 public:
  virtual ~ScanSource() = default;

  virtual const std::vector<Attribute>& attributes() const = 0;

  /// The next record, finite or not; false at the end.
  /// @param attributes  attribute_stride() bytes to fill, or nullptr where they are not wanted
  virtual bool next(Eigen::Vector3d& point, std::byte* attributes) = 0;
};

}  // namespace tcm_icp
