#pragma once
// The XML part of an E57 file that is written: what its scans and their columns are.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// How a column's values stand in their byte stream: integers from the lowest of their type on, flags a bit each.
enum class E57Coding { kFloat32, kFloat64, kInteger, kFlag };

struct E57Column {
  std::string name;  ///< of the element
  E57Coding coding = E57Coding::kFloat64;
  ScalarType type = ScalarType::kFloat64;
  std::size_t from = 0;  ///< [bytes] in the record
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
};

/// 128 bits that tell one content from another.
class E57Digest {
 public:
  void add(const void* bytes, std::size_t size);
  std::string guid() const;  ///< "{...}": the same for the same content, in every run

 private:
  std::array<std::uint64_t, 2> state_{};
};

struct E57WrittenScan {
  std::string name;
  Eigen::Isometry3d T_file_scan = Eigen::Isometry3d::Identity();
  std::vector<E57Column> columns;  ///< x, y and z first
  std::uint64_t num_points = 0;
  std::uint64_t physical_offset = 0;  ///< [bytes] of its section
  E57Digest digest;
};

/// Lowest and highest integer of a type.
std::pair<std::int64_t, std::int64_t> e57_range(ScalarType type);

/// @param description        of every scan
/// @param coordinate_system  well-known text; empty: not told
std::string e57_xml(const std::vector<E57WrittenScan>& scans, const std::string& description,
                    const std::string& coordinate_system);

}  // namespace tcm_icp
