#pragma once
// What tests of writers write.

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp::test {

/// Attributes of a block.
inline std::vector<std::byte> packed(const std::string& bytes) {
  std::vector<std::byte> out(bytes.size());
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

/// A turn about no axis of the frame, and a shift to projected coordinates.
inline Eigen::Isometry3d to_utm() {
  Twist twist;
  twist << 0.7, -1.1, 2.0, 500000, 5000000, 100;
  return isometry_from_twist(twist);
}

}  // namespace tcm_icp::test
