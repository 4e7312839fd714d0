#pragma once
// A block of a scan as it streams by: raw coordinates and whatever else the file says of each point.

#include <cstddef>
#include <string>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// The scalar types of the PLY format.
enum class ScalarType { kInt8, kUInt8, kInt16, kUInt16, kInt32, kUInt32, kFloat32, kFloat64 };

/// Bytes of one value: 1, 2, 4 or 8.
std::size_t scalar_size(ScalarType type);

/// What a file holds for each point beside x y z: intensity, normals, colour, time, ...
struct Attribute {
  std::string name;                        ///< unique in a scan, without blanks
  ScalarType type = ScalarType::kFloat64;  ///< of each value
  /// Same name, same type.
  friend bool operator==(const Attribute&, const Attribute&) = default;
};

/// Bytes of one point's attributes, packed in their order.
std::size_t attribute_stride(const std::vector<Attribute>& attributes);

/// Some of the points of a scan, in its order.
struct PointBlock {
  Points points;                      ///< [unit of the file] raw coordinates, finite
  std::vector<std::byte> attributes;  ///< size() * stride bytes, packed, native byte order

  std::size_t size() const { return points.size(); }  ///< number of points
};

}  // namespace tcm_icp
